#include "regionmesh/simplify.h"

#include <algorithm>
#include <cmath>
#include <thread>
#include <utility>

#include "base/option_range.h"
#include "judge/error_bound.h"
#include "mesh/extent.h"
#include "regionmesh/box_axes.h"
#include "regionmesh/mesh.h"
#include "simplify/collapse_edges.h"
#include "simplify/tiles/mesh_chunk.h"
#include "simplify/tiles/threshold_passes.h"

namespace regionmesh {
namespace {

/// Cubes as large as a typical edge serve as the cells that tiles are made of.
TilePlan plan_of(const Mesh& mesh, double edge, std::uint32_t threads) {
    const Box extent = extent_of(mesh, threads);
    const Vec3 size = extent.high - extent.low;
    const double cell = std::max(edge, std::max({size.x, size.y, size.z}) / kMostCells);
    TilePlan plan{.lattice = {}, .sweep = kSweepZ, .chunk_strips = 1, .tile_cells = 1, .is_bounded = false};
    plan.lattice.origin = extent.low;
    plan.lattice.spacing = {cell, cell, cell};
    for (int axis = 0; axis < 3; ++axis)
        plan.lattice.size[axis] = static_cast<std::uint32_t>(std::floor(size[axis] / cell)) + 2;
    return plan;
}

std::size_t bytes_of(const Chunk& chunk) {
    return chunk.vertices.size() * sizeof(ChunkVertex) + chunk.faces.size() * sizeof(ChunkFace);
}

/// Large meshes: in tiles, near the target. `before` and `after` are both held. False if it did nothing; otherwise the
/// mesh is sorted.
bool simplify_by_tiles(Mesh& mesh, const SimplifyOptions& options, SimplifyResult& result) {
    if (mesh.face_count() <= options.target_faces || mesh.face_count() < kFewestTiles * kTileFaces) return false;
    const double edge = typical_edge(mesh);
    const TilePlan plan = plan_of(mesh, edge, options.threads);
    result.bytes = mesh.bytes();
    Chunk chunk = take_chunk(mesh);
    const std::size_t before = bytes_of(chunk);
    result.bytes += before;
    const double share = static_cast<double>(options.target_faces) / static_cast<double>(chunk.faces.size());
    const double aim = std::min(options.target_faces * kTrimMargin, static_cast<double>(chunk.faces.size()));
    PassOptions passes{
        .target_faces = static_cast<std::uint64_t>(aim),
        .tiles = {.threshold = kTileThreshold * std::pow(kEdgesPerSpacing * edge / options.promises.scale, 4),
                  .keep_share = share * kTileMargin,
                  .free_share = share > kFreeFrom ? share * kFreeMargin : 1,
                  .threads = options.threads,
                  .simplify = options}};
    std::uint64_t left = chunk.faces.size();
    if (options.on_progress)
        passes.tiles.on_share = [&, caller = std::this_thread::get_id()](double) {
            if (std::this_thread::get_id() == caller) options.on_progress(left);
        };
    if (share * kTileMargin < 1) {
        const PassResult done = simplify_below(chunk, plan, passes);
        result.verdicts = done.verdicts;
        result.tile_passes = done.passes;
    }
    left = chunk.faces.size();
    passes.tiles.free_share = 1;
    const PassResult done = simplify_in_passes(chunk, plan, passes);
    add(result.verdicts, done.verdicts);
    result.tile_passes += done.passes;
    const std::size_t after = bytes_of(chunk);
    mesh = sorted_mesh_of(std::move(chunk), options.threads);
    result.bytes = std::max({result.bytes, before + after, after + mesh.bytes()});
    return true;
}

void require_options(const SimplifyOptions& options) {
    require_number("max_cost", options.max_cost, kNotNegativeOrInfinite);
    require_in_range(options.promises);
    require_number("perturbation", options.perturbation, kNotNegative);
    require_choice("placement", options.placement, PlacementKind::kLindstromTurk);
}

}  // namespace

SimplifyResult simplify(Mesh& mesh, const SimplifyOptions& options) {
    require_options(options);
    require_along_axes(mesh);
    SimplifyResult result;
    for (std::uint32_t v = 0; v < mesh.vertex_end(); ++v) mesh[VertexId{v}].set_error_bound(0);
    if (!simplify_by_tiles(mesh, options, result)) mesh.sort_spatially(options.threads);
    const std::size_t mesh_bytes = mesh.bytes();
    const CollapseResult done = collapse_edges(mesh, options, {.threads = options.threads});
    add(result.verdicts, done.verdicts);
    result.refreshes = done.refreshes;
    result.stopped = done.stopped;
    result.error_bound = largest_error_bound(mesh);
    result.bytes = std::max(result.bytes, mesh_bytes + done.bytes);
    return result;
}

}  // namespace regionmesh
