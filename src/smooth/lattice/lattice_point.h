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

/// A position in whole steps from the origin of the lattice; what lies a little before it wraps round.
struct LatticePoint {
    std::array<std::uint32_t, 3> at{};
};

/// How long a step is along each axis: a power of two of finest spacings, between 1/16384 and 1/8192 of the spacing of
/// the samples. Differences of points near each other are exact however far from the origin they lie, and fit single
/// precision.
class LatticeSteps {
public:
    /// Positions reach up to this many steps: at least 245,760 samples.
    static constexpr std::uint32_t kMost = 0xf0000000;

    /// In finest spacings.
    explicit LatticeSteps(Vec3 spacing) {
        for (int axis = 0; axis < 3; ++axis) size_[axis] = std::ldexp(1.0f, std::ilogb(spacing[axis]) - 13);
    }
    float size(int axis) const { return size_[axis]; }
    /// In finest spacings from the origin.
    double coordinate(const LatticePoint& p, int axis) const { return double{size_[axis]} * p.at[axis]; }
    /// In finest spacings; exact where it is less than 2^24 steps.
    Float3 between(const LatticePoint& from, const LatticePoint& to) const {
        const auto along = [&](int axis) {
            return size_[axis] * static_cast<float>(static_cast<std::int32_t>(to.at[axis] - from.at[axis]));
        };
        return {along(0), along(1), along(2)};
    }
    /// Requires an offset of less than 2^31 steps.
    LatticePoint moved(LatticePoint p, Float3 offset) const {
        const float lengths[3] = {offset.x, offset.y, offset.z};
        for (int axis = 0; axis < 3; ++axis)
            p.at[axis] +=
                static_cast<std::uint32_t>(static_cast<std::int32_t>(std::lround(lengths[axis] / size_[axis])));
        return p;
    }

private:
    std::array<float, 3> size_{};
};

}  // namespace regionmesh
