// The cells of a volume cut into blocks.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "regionmesh/lattice.h"
#include "simplify/tiles/tile_grid.h"

namespace regionmesh {

/// Blocks of `block` cells along each axis, numbered with x fastest; the first of an axis is `shift` cells shorter, the
/// last ends with the volume. A face belongs to the block that its centroid lies in.
class BlockGrid {
public:
    /// Requires at least two samples along every axis, and shift < block.
    BlockGrid(const Lattice& lattice, std::uint32_t block, std::uint32_t shift = 0)
        : grid_{.origin = lattice.origin, .spacing = lattice.spacing, .size = {}, .cells = {}} {
        for (int axis = 0; axis < 3; ++axis) {
            grid_.size[axis] = lattice.size[axis] - 1;
            grid_.cells[axis] = block;
            grid_.shift[axis] = shift;
        }
    }

    std::uint32_t count() const { return grid_.tile_count(); }
    std::array<std::uint32_t, 3> counts() const { return {grid_.count(0), grid_.count(1), grid_.count(2)}; }
    std::uint32_t block_at(Vec3 centroid) const { return grid_.tile_at(centroid); }
    /// Holds all points that block_at() puts into the block, however they are rounded, and its walls.
    Box reach(std::uint32_t block) const {
        constexpr double kMargin = 0x1p-8;  // of a cell: coordinates have 12 bits below the spacing or more
        const auto own = place(block), end = counts();
        Box reach = limits(block);
        for (int axis = 0; axis < 3; ++axis) {
            reach.low[axis] = own[axis] == 0 ? -HUGE_VAL : reach.low[axis] - kMargin * grid_.spacing[axis];
            reach.high[axis] = own[axis] + 1 == end[axis] ? HUGE_VAL : reach.high[axis] + kMargin * grid_.spacing[axis];
        }
        return reach;
    }
    /// Its walls, exactly where the samples lie.
    Box limits(std::uint32_t block) const { return grid_.limits(block); }
    Box limits(const IndexBox& blocks) const {
        const auto& [x, y, z] = blocks.high;
        return {limits(number(blocks.low)).low, limits(number({x - 1, y - 1, z - 1})).high};
    }

    /// Where a block lies, in blocks along x, y, z.
    std::array<std::uint32_t, 3> place(std::uint32_t block) const {
        return {block % grid_.count(0), block / grid_.count(0) % grid_.count(1),
                block / grid_.count(0) / grid_.count(1)};
    }
    std::uint32_t number(const std::array<std::uint32_t, 3>& place) const {
        return (place[2] * grid_.count(1) + place[1]) * grid_.count(0) + place[0];
    }

    /// Calls visit(block) for all blocks of a box of them, in their order.
    template <class Visit>
    void for_blocks(const IndexBox& blocks, Visit&& visit) const {
        for (std::uint32_t z = blocks.low[2]; z < blocks.high[2]; ++z)
            for (std::uint32_t y = blocks.low[1]; y < blocks.high[1]; ++y)
                for (std::uint32_t x = blocks.low[0]; x < blocks.high[0]; ++x) visit(number({x, y, z}));
    }

    /// Number of blocks of a box of them.
    static std::uint32_t count(const IndexBox& blocks) {
        const auto [x, y, z] = blocks.size();
        return x * y * z;
    }

    /// The cells of a block, and of a box of blocks.
    IndexBox cells(std::uint32_t block) const {
        const auto [x, y, z] = place(block);
        return cells({{x, y, z}, {x + 1, y + 1, z + 1}});
    }
    IndexBox cells(const IndexBox& blocks) const {
        IndexBox box;
        for (int axis = 0; axis < 3; ++axis) {
            const auto wall = [&](std::uint32_t n) {
                const std::uint64_t at = std::uint64_t{n} * grid_.cells[axis];
                return static_cast<std::uint32_t>(
                    std::min<std::uint64_t>(at - std::min<std::uint64_t>(at, grid_.shift[axis]), grid_.size[axis]));
            };
            box.low[axis] = wall(blocks.low[axis]);
            box.high[axis] = wall(blocks.high[axis]);
        }
        return box;
    }

private:
    TileGrid grid_;
};

/// The samples of the cells of a box and `halo` samples more on each side, as far as the volume goes.
inline IndexBox samples_with_halo(const IndexBox& cells, const std::array<std::uint32_t, 3>& halo,
                                  const std::array<std::uint32_t, 3>& samples) {
    IndexBox box;
    for (int axis = 0; axis < 3; ++axis) {
        box.low[axis] = cells.low[axis] - std::min(cells.low[axis], halo[axis]);
        box.high[axis] = static_cast<std::uint32_t>(
            std::min<std::uint64_t>(std::uint64_t{cells.high[axis]} + 1 + halo[axis], samples[axis]));
    }
    return box;
}

}  // namespace regionmesh
