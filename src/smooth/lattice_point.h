// Vectors and positions in single precision, as the fits of the lattice filter use them.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "base/lanes.h"
#include "regionmesh/vec3.h"

namespace regionmesh {

struct Float3 {
    float x = 0, y = 0, z = 0;

    Float3() = default;
    Float3(float a, float b, float c) : x(a), y(b), z(c) {}
    explicit Float3(Vec3 v) : x(static_cast<float>(v.x)), y(static_cast<float>(v.y)), z(static_cast<float>(v.z)) {}
    Vec3 wide() const { return {x, y, z}; }
};
inline Float3 operator+(Float3 a, Float3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Float3 operator-(Float3 a, Float3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Float3 operator*(float s, Float3 a) { return {s * a.x, s * a.y, s * a.z}; }
inline Float3& operator+=(Float3& a, Float3 b) { return a = a + b; }
inline float dot(Float3 a, Float3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline float length(Float3 a) { return std::sqrt(dot(a, a)); }
inline Float3 cross(Float3 a, Float3 b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

inline Lanes3<Float4> all_four(Float3 p) { return {all_four(p.x), all_four(p.y), all_four(p.z)}; }

inline Lanes3<Float4> side_by_side(Float3 a, Float3 b, Float3 c, Float3 d) {
    return {Float4{a.x, b.x, c.x, d.x}, Float4{a.y, b.y, c.y, d.y}, Float4{a.z, b.z, c.z, d.z}};
}

/// A position in whole steps of kStep finest spacings, modulo 2^32: differences of points near each other are exact
/// however far from the origin they lie, and fit single precision.
struct LatticePoint {
    static constexpr double kStep = 1.0 / 8192;

    std::array<std::uint32_t, 3> at{};

    /// Difference in finest spacings; exact where it is less than 2^24 steps.
    friend Float3 operator-(const LatticePoint& a, const LatticePoint& b) {
        const auto along = [&](int axis) {
            return static_cast<float>(static_cast<std::int32_t>(a.at[axis] - b.at[axis])) * static_cast<float>(kStep);
        };
        return {along(0), along(1), along(2)};
    }
    /// Requires an offset of less than 2^18 finest spacings.
    friend LatticePoint operator+(LatticePoint a, Float3 offset) {
        const float steps[3] = {offset.x, offset.y, offset.z};
        for (int axis = 0; axis < 3; ++axis)
            a.at[axis] += static_cast<std::uint32_t>(static_cast<std::int32_t>(std::lround(steps[axis] / kStep)));
        return a;
    }
};

}  // namespace regionmesh
