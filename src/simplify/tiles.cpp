#include "simplify/tiles.h"

#include <algorithm>

namespace regionmesh {
namespace {

constexpr std::uint32_t kTileCells = 24;
constexpr std::uint32_t kShortestRun = 8;
constexpr std::uint64_t kSamplesPerRun = 2u << 20;

/// Columns along the sweep.
BoxGrid grid_of(const TilePlan& plan, RunExtent extent) {
    BoxGrid grid{.origin = plan.lattice.origin, .spacing = plan.lattice.spacing, .size = {}, .cells = {}};
    for (int axis = 0; axis < 3; ++axis) {
        grid.size[axis] = plan.lattice.size[axis] - 1;
        grid.cells[axis] = plan.tile_cells;
    }
    const int along = plan.sweep.axes[2];
    grid.cells[along] = std::max(grid.size[along], 1u);
    grid.extent.low[along] = extent.low;
    grid.extent.high[along] = extent.high;
    return grid;
}

}  // namespace

TilePlan plan_tiles(const Lattice& lattice, Sweep sweep) {
    const std::uint64_t section = std::uint64_t{lattice.size[sweep.axes[0]]} * lattice.size[sweep.axes[1]];
    const auto strips =
        static_cast<std::uint32_t>(std::clamp<std::uint64_t>(kSamplesPerRun / section, kShortestRun, kTileCells));
    return {lattice, sweep, strips, kTileCells};
}

VerdictCounts decimate_tiles(Chunk& batch, std::span<const ChunkVertex> carried, RunExtent extent, const TilePlan& plan,
                             const TileOptions& options) {
    const BoxGrid grid = grid_of(plan, extent);
    BoxedFaces faces(batch, carried, grid, options.threads);
    TileResult result = decimate_boxes(faces, options);
    batch = std::move(result.left);
    return result.verdicts;
}

}  // namespace regionmesh
