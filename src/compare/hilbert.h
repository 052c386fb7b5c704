// Hilbert's curve through a box: positions near each other along it are near in space; it has no jumps, unlike a Morton
// curve.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "regionmesh/vec3.h"

namespace regionmesh {

inline constexpr int kHilbertBits = 10;  // per axis

/// Position along the curve of a cell in a grid of 2^kHilbertBits cells per axis (Skilling 2004, "Programming the
/// Hilbert curve").
inline std::uint32_t hilbert_key(std::array<std::uint32_t, 3> x) {
    constexpr std::uint32_t kTop = 1u << (kHilbertBits - 1);
    for (std::uint32_t q = kTop; q > 1; q >>= 1) {
        const std::uint32_t below = q - 1;
        for (std::uint32_t& coordinate : x) {
            const std::uint32_t is_set = 0u - static_cast<std::uint32_t>((coordinate & q) != 0);
            const std::uint32_t exchanged = (x[0] ^ coordinate) & below & ~is_set;
            x[0] ^= exchanged | (below & is_set);
            coordinate ^= exchanged;
        }
    }
    x[1] ^= x[0];
    x[2] ^= x[1];
    std::uint32_t turned = 0;
    for (std::uint32_t q = kTop; q > 1; q >>= 1)
        if (x[2] & q) turned ^= q - 1;
    std::uint32_t key = 0;
    for (int bit = kHilbertBits - 1; bit >= 0; --bit)
        for (std::uint32_t coordinate : x) key = key << 1 | ((coordinate ^ turned) >> bit & 1);
    return key;
}

/// The grid over a box.
class HilbertGrid {
public:
    explicit HilbertGrid(const Box& box) : origin_(box.low) {
        const Vec3 extent = box.high - box.low;
        cells_per_length_ = kLast / std::max({extent.x, extent.y, extent.z, 1e-300});
    }

    /// Points outside the box are moved to its boundary.
    std::uint32_t key(Vec3 p) const {
        std::array<std::uint32_t, 3> cell;
        for (int axis = 0; axis < 3; ++axis)
            cell[axis] =
                static_cast<std::uint32_t>(std::clamp((p[axis] - origin_[axis]) * cells_per_length_, 0.0, kLast));
        return hilbert_key(cell);
    }

private:
    static constexpr double kLast = (1u << kHilbertBits) - 1;

    Vec3 origin_;
    double cells_per_length_;
};

}  // namespace regionmesh
