#include "simplify/tiles/tiles.h"

#include <algorithm>
#include <cmath>

#include "simplify/collapse_edges.h"

namespace regionmesh {
namespace {

/// Columns along the sweep.
TileGrid grid_of(const TilePlan& plan, SafeInterval safe) {
    const int sweep = plan.sweep.axes[2];
    TileGrid grid{.origin = plan.lattice.origin,
                  .spacing = plan.lattice.spacing,
                  .size = {},
                  .cells = {},
                  .extent = box_of(safe, sweep),
                  .first_cell = plan.first_cell,
                  .is_bounded = plan.is_bounded};
    for (int axis = 0; axis < 3; ++axis) {
        grid.size[axis] = plan.lattice.size[axis] - 1;
        grid.cells[axis] = plan.tile_cells;
    }
    grid.cells[sweep] = std::max(grid.size[sweep], 1u);
    return grid;
}

/// Side of a tile. Where sections are thin, tiles are wider and have about as many cells as a cube; at least
/// kFewestAlong of them lie along each of the other axes.
std::uint32_t tile_side(const Lattice& lattice, Sweep sweep) {
    const auto cells = [&](int n) { return std::max(lattice.size[sweep.axes[n]], 2u) - 1; };
    const std::uint32_t thin = std::min({cells(0), cells(1), kTileCells});
    const auto wide = static_cast<std::uint32_t>(kTileCells * std::sqrt(double{kTileCells} / thin));
    return std::max(std::min({wide, std::max(cells(0), cells(1)) / kFewestAlong, cells(2) / kFewestAlong}), kTileCells);
}

}  // namespace

TilePlan plan_tiles(const Lattice& lattice, Sweep sweep) {
    const std::uint64_t section = std::uint64_t{lattice.size[sweep.axes[0]]} * lattice.size[sweep.axes[1]];
    const std::uint32_t side = tile_side(lattice, sweep);
    const auto strips =
        static_cast<std::uint32_t>(std::clamp<std::uint64_t>(kSamplesPerChunk / section, kShortestChunk, side));
    return {lattice, sweep, strips, side};
}

TileResult simplify_chunk(const Chunk& chunk, std::span<const ChunkVertex> carried, SafeInterval safe,
                          const TilePlan& plan, const TileOptions& options) {
    const TileGrid grid = grid_of(plan, safe);
    TiledFaces faces(chunk, carried, grid, options.threads);
    return simplify_tiles(faces, options);
}

}  // namespace regionmesh
