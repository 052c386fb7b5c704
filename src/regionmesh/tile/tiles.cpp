#include "regionmesh/tile/tiles.h"

#include <algorithm>
#include <cmath>

#include "regionmesh/base/parallel_in_order.h"
#include "regionmesh/tile/boxed_faces.h"
#include "regionmesh/tile/tile.h"

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

DecimateOptions options_for(const TileOptions& options, std::uint32_t face_count, const Box& limits) {
    DecimateOptions own = options.decimate;
    own.target_faces = static_cast<std::uint32_t>(std::ceil(options.keep_share * face_count));
    own.max_cost = options.cost_level * std::pow(own.scale, 4);
    own.refresh = false;
    own.limits = limits;
    return own;
}

}  // namespace

TilePlan plan_tiles(const Lattice& lattice, Sweep sweep) {
    const std::uint64_t section = std::uint64_t{lattice.size[sweep.axes[0]]} * lattice.size[sweep.axes[1]];
    const auto strips =
        static_cast<std::uint32_t>(std::clamp<std::uint64_t>(kSamplesPerRun / section, kShortestRun, kTileCells));
    return {lattice, sweep, strips, kTileCells};
}

TileResult decimate_tiles(FaceBatch& batch, std::span<const BatchVertex> carried, RunExtent extent,
                          const TilePlan& plan, const TileOptions& options) {
    return decimate_boxes(batch, carried, grid_of(plan, extent), options);
}

TileResult decimate_boxes(FaceBatch& batch, std::span<const BatchVertex> carried, const BoxGrid& grid,
                          const TileOptions& options) {
    BoxedFaces faces(batch, carried, grid, options.threads);
    // What was never touched of the room costs nothing.
    FaceBatch made{.carried = batch.carried, .vertices = faces.rim_vertices(), .faces = {}, .open = {}};
    made.vertices.reserve(batch.vertices.size());
    made.faces.reserve(batch.faces.size());
    for (std::uint32_t local : batch.open) made.open.push_back(faces.rim_number(local));
    TileResult result;
    std::vector<Tile> tiles(std::max(options.in_flight, 1u));
    std::vector<DecimateResult> done(tiles.size());
    const auto work = [&](std::uint32_t box, std::uint32_t place) {
        Tile& tile = tiles[place];
        tile.take_out(faces, box);
        done[place] = tile.decimate(options_for(options, tile.face_count(), grid.limits(box)));
        tile.note_left(faces, box);
    };
    const auto finish = [&](std::uint32_t, std::uint32_t place) {
        tiles[place].put_back(made);
        for (int n = 0; n < kVerdictCount; ++n) result.verdicts[n] += done[place].verdicts[n];
    };
    parallel_in_order(grid.box_count(), options.in_flight, options.threads, {work, finish});
    batch = std::move(made);
    return result;
}

}  // namespace regionmesh
