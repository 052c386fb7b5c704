// The cells of a volume cut into blocks.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "regionmesh/lattice.h"
#include "simplify/tile_grid.h"

namespace regionmesh {

/// Cells, or samples, from `low` to `high` - 1 along x, y, z.
struct IndexBox {
    std::array<std::uint32_t, 3> low{}, high{};

    std::array<std::uint32_t, 3> size() const { return {high[0] - low[0], high[1] - low[1], high[2] - low[2]}; }
    friend bool operator==(const IndexBox&, const IndexBox&) = default;
};

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
    /// Its walls, exactly where the samples lie.
    Box limits(std::uint32_t block) const { return grid_.limits(block); }

    /// The cells of a block.
    IndexBox cells(std::uint32_t block) const {
        const std::array<std::uint32_t, 3> place{block % grid_.count(0), block / grid_.count(0) % grid_.count(1),
                                                 block / grid_.count(0) / grid_.count(1)};
        IndexBox box;
        for (int axis = 0; axis < 3; ++axis) {
            const auto wall = [&](std::uint32_t n) {
                const std::uint64_t at = std::uint64_t{n} * grid_.cells[axis];
                return static_cast<std::uint32_t>(
                    std::min<std::uint64_t>(at - std::min<std::uint64_t>(at, grid_.shift[axis]), grid_.size[axis]));
            };
            box.low[axis] = wall(place[axis]);
            box.high[axis] = wall(place[axis] + 1);
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
