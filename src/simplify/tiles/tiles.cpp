#include "simplify/tiles/tiles.h"

#include <algorithm>
#include <cmath>

#include "simplify/collapse_edges.h"

namespace regionmesh {
namespace {

/// Side of a tile. Where sections are thin, tiles are wider and have about as many cells as a cube; at least
/// kFewestAlong of them lie along each of the other axes.
std::uint32_t tile_side(const Lattice& lattice, Sweep sweep) {
    const auto cells = [&](int n) { return std::max(lattice.size[sweep.axes[n]], 2u) - 1; };
    const std::uint32_t thin = std::min({cells(0), cells(1), kTileCells});
    const auto wide = static_cast<std::uint32_t>(kTileCells * std::sqrt(double{kTileCells} / thin));
    return std::max(std::min({wide, std::max(cells(0), cells(1)) / kFewestAlong, cells(2) / kFewestAlong}), kTileCells);
}

}  // namespace

TileGrid grid_of(const TilePlan& plan, std::array<std::uint32_t, 3> cells, std::array<std::uint32_t, 3> shift,
                 SafeInterval safe) {
    TileGrid grid{.origin = plan.lattice.origin,
                  .spacing = plan.lattice.spacing,
                  .size = {},
                  .cells = cells,
                  .shift = shift,
                  .extent = box_of(safe, plan.sweep.axes[2]),
                  .first_cell = plan.first_cell,
                  .is_bounded = plan.is_bounded};
    for (int axis = 0; axis < 3; ++axis) {
        grid.size[axis] = plan.lattice.size[axis] - 1;
        if (grid.cells[axis] == 0) grid.cells[axis] = std::max(grid.size[axis], 1u);
    }
    return grid;
}

TileOptions first_stage(const SimplifyOptions& simplify, double share, std::uint32_t threads) {
    return {.threshold = kTileThreshold,
            .keep_share = std::min(share * kTileMargin, 1.0),
            .free_share = share > kFreeFrom ? share * kFreeMargin : 1,
            .threads = threads,
            .simplify = simplify};
}

TilePlan plan_tiles(const Lattice& lattice, Sweep sweep) {
    const std::uint64_t section = std::uint64_t{lattice.size[sweep.axes[0]]} * lattice.size[sweep.axes[1]];
    const std::uint32_t side = tile_side(lattice, sweep);
    const auto strips =
        static_cast<std::uint32_t>(std::clamp<std::uint64_t>(kSamplesPerChunk / section, kShortestChunk, side));
    return {lattice, sweep, strips, side};
}

TileResult simplify_chunk(const Chunk& chunk, std::span<const ChunkVertex> carried, SafeInterval safe,
                          const TilePlan& plan, const TileOptions& options) {
    std::array<std::uint32_t, 3> cells{plan.tile_cells, plan.tile_cells, plan.tile_cells};
    cells[plan.sweep.axes[2]] = 0;  // columns along the sweep
    const TileGrid grid = grid_of(plan, cells, {}, safe);
    TiledFaces faces(chunk, carried, grid, options.threads);
    return simplify_tiles(faces, options);
}

}  // namespace regionmesh
