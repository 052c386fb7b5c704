// A volume cut into tiles by planes of samples.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "regionmesh/lattice.h"
#include "regionmesh/vec3.h"

namespace regionmesh {

/// Tiles of `cells` cells along x, y, z; the first of an axis is `shift` cells shorter, the last ends with the volume.
/// All are cut by `extent`.
struct TileGrid {
    Vec3 origin, spacing;               // of the samples
    std::array<std::uint32_t, 3> size;  // cells of the volume, or of a block of it
    std::array<std::uint32_t, 3> cells;
    std::array<std::uint32_t, 3> shift{0, 0, 0};
    Box extent{{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}, {HUGE_VAL, HUGE_VAL, HUGE_VAL}};
    std::array<std::uint32_t, 3> first_cell{0, 0, 0};  // of a block; the origin is that of the whole volume
    bool is_bounded = true;  // false: the outermost tiles reach beyond the volume, without end

    std::uint32_t count(int axis) const {
        return std::max((size[axis] + shift[axis] + cells[axis] - 1) / cells[axis], 1u);
    }
    std::uint32_t tile_count() const { return count(0) * count(1) * count(2); }

    /// The tile of the cell that a point lies in; of the nearest cell for a point outside the volume.
    std::uint32_t tile_at(Vec3 p) const { return number({along(0, p.x), along(1, p.y), along(2, p.z)}); }

    Box limits(std::uint32_t tile) const {
        const std::array<std::uint32_t, 3> place{tile % count(0), tile / count(0) % count(1),
                                                 tile / count(0) / count(1)};
        Box limits;
        for (int axis = 0; axis < 3; ++axis) {
            limits.low[axis] = std::max(wall(axis, place[axis]), extent.low[axis]);
            limits.high[axis] = std::min(wall(axis, place[axis] + 1), extent.high[axis]);
        }
        return limits;
    }

    /// Calls visit(tile) for all tiles that may touch this box, in their order.
    template <class Visit>
    void for_tiles_at(const Box& box, Visit&& visit) const {
        std::array<std::uint32_t, 3> first, last;
        for (int axis = 0; axis < 3; ++axis) {
            first[axis] = along(axis, box.low[axis]);
            last[axis] = along(axis, box.high[axis]);
        }
        for (std::uint32_t z = first[2]; z <= last[2]; ++z)
            for (std::uint32_t y = first[1]; y <= last[1]; ++y)
                for (std::uint32_t x = first[0]; x <= last[0]; ++x) visit(number({x, y, z}));
    }

private:
    std::uint32_t number(std::array<std::uint32_t, 3> place) const {
        return (place[2] * count(1) + place[1]) * count(0) + place[0];
    }
    std::uint32_t along(int axis, double x) const {
        const double cell = std::floor((x - origin[axis]) / spacing[axis]) - first_cell[axis];
        const auto inside = static_cast<std::uint32_t>(std::clamp(cell, 0.0, std::max(size[axis], 1u) - 1.0));
        return (inside + shift[axis]) / cells[axis];
    }
    /// The lower side of tile n, exactly where the samples lie.
    double wall(int axis, std::uint32_t n) const {
        if (!is_bounded && n == 0) return -HUGE_VAL;
        if (!is_bounded && n >= count(axis)) return HUGE_VAL;
        const std::uint64_t cell = std::uint64_t{n} * cells[axis];
        const std::uint64_t at = std::min<std::uint64_t>(cell - std::min<std::uint64_t>(cell, shift[axis]), size[axis]);
        return origin[axis] + static_cast<double>(first_cell[axis] + at) * spacing[axis];
    }
};

}  // namespace regionmesh
