// Numbers that a seed makes, the same everywhere.
#pragma once

#include <cstdint>

#include "base/hash.h"
#include "regionmesh/vec3.h"

namespace regionmesh::test {

class Random {
public:
    explicit Random(std::uint64_t seed) : state_(mix64(seed)) {}

    std::uint32_t below(std::uint32_t end) { return static_cast<std::uint32_t>((state_ = mix64(state_)) >> 11) % end; }
    /// In [0, 1).
    double unit() { return static_cast<double>((state_ = mix64(state_)) >> 11) * 0x1p-53; }
    double between(double low, double high) { return low + (high - low) * unit(); }
    /// In a box round the origin.
    Vec3 point(double reach) { return {between(-reach, reach), between(-reach, reach), between(-reach, reach)}; }
    /// With whole numbers from -reach to reach: many lie in line or in one plane.
    Vec3 lattice_point(int reach) {
        const auto whole = [&] {
            return static_cast<double>(below(2 * static_cast<std::uint32_t>(reach) + 1)) - reach;
        };
        return {whole(), whole(), whole()};
    }

private:
    std::uint64_t state_;
};

}  // namespace regionmesh::test
