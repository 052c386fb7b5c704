// A spatial order: neighbours in it are mostly neighbours in space.
#pragma once

#include <algorithm>
#include <cstdint>

#include "regionmesh/vec3.h"

namespace regionmesh {

/// Maps points of a box to the cells of a 1024^3 grid, numbered along a Morton curve.
class MortonCurve {
public:
    explicit MortonCurve(const Box& box) : low_(box.low) {
        const Vec3 extent = box.high - box.low;
        cells_ = 1023 / std::max({extent.x, extent.y, extent.z, 1e-300});
    }
    std::uint32_t operator()(Vec3 p) const {
        const Vec3 cell = (p - low_) * cells_;
        const auto bits = [](double x) { return spread(static_cast<std::uint32_t>(std::clamp(x, 0.0, 1023.0))); };
        return bits(cell.x) | bits(cell.y) << 1 | bits(cell.z) << 2;
    }

private:
    /// Spreads the low ten bits with two zeros between neighbours.
    static std::uint32_t spread(std::uint32_t x) {
        x = (x | x << 16) & 0x030000FFu;
        x = (x | x << 8) & 0x0300F00Fu;
        x = (x | x << 4) & 0x030C30C3u;
        return (x | x << 2) & 0x09249249u;
    }

    Vec3 low_;
    double cells_;
};

}  // namespace regionmesh
