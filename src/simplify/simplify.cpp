#include "regionmesh/simplify.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/option_range.h"
#include "judge/error_bound.h"
#include "mesh/extent.h"
#include "regionmesh/box_axes.h"
#include "regionmesh/mesh.h"
#include "simplify/decimate.h"
#include "simplify/tiles/mesh_chunk.h"

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
    for (std::uint32_t v = 0; v < mesh.vertex_end(); ++v) mesh[VertexId{v}].set_error_bound(0);
    DecimatePlan plan{.tiles = {}, .margin = kTrimMargin, .last = {.threads = options.threads}};
    DecimateResult done;
    if (mesh.face_count() <= options.target_faces || mesh.face_count() < kFewestTiles * kTileFaces) {
        mesh.sort_spatially(options.threads);
        collapse_to_target(mesh, plan, options, done);
    } else {
        const double edge = typical_edge(mesh);
        plan.tiles = plan_of(mesh, edge, options.threads);
        plan.first_threshold = kTileThreshold * std::pow(kEdgesPerSpacing * edge / options.promises.scale, 4);
        const std::size_t mesh_bytes = mesh.bytes();
        Chunk surface = take_chunk(mesh);
        done.bytes = mesh_bytes + bytes_of(surface);
        mesh = decimate(std::move(surface), plan, options, done);
    }
    return {.verdicts = done.verdicts,
            .tile_passes = done.tile_passes,
            .refreshes = done.refreshes,
            .stopped = done.stopped,
            .error_bound = largest_error_bound(mesh),
            .bytes = done.bytes};
}

}  // namespace regionmesh
