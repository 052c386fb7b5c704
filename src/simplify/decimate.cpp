#include "simplify/decimate.h"

#include <algorithm>
#include <thread>
#include <utility>

#include "judge/error_bound.h"
#include "simplify/tiles/mesh_chunk.h"

namespace regionmesh {
namespace {

void pass_in_tiles(Chunk& surface, const DecimatePlan& plan, const SimplifyOptions& options, DecimateResult& result) {
    const auto held = static_cast<double>(surface.faces.size());
    const double share = static_cast<double>(options.target_faces) / held;
    PassOptions passes{.target_faces = static_cast<std::uint64_t>(std::min(options.target_faces * plan.margin, held)),
                       .tiles = first_stage(options, share, options.threads)};
    std::uint64_t left = surface.faces.size();
    if (options.on_progress)
        passes.tiles.on_share = [&, caller = std::this_thread::get_id()](double) {
            if (std::this_thread::get_id() == caller) options.on_progress(left);
        };
    const auto note = [&](const PassResult& done) {
        add(result.verdicts, done.verdicts);
        result.tile_passes += done.passes;
    };
    if (plan.first_threshold > 0 && share * kTileMargin < 1) {
        passes.tiles.threshold = plan.first_threshold;
        note(simplify_below(surface, plan.tiles, passes));
        left = surface.faces.size();
    }
    passes.tiles.free_share = 1;
    note(simplify_in_passes(surface, plan.tiles, passes));
}

}  // namespace

Mesh decimate(Chunk surface, const DecimatePlan& plan, const SimplifyOptions& options, DecimateResult& result) {
    const std::size_t before = bytes_of(surface);
    pass_in_tiles(surface, plan, options, result);
    const std::size_t after = bytes_of(surface);
    Mesh mesh = sorted_mesh_of(std::move(surface), options.threads);
    result.bytes = std::max({result.bytes, before + after, after + mesh.bytes()});
    collapse_to_target(mesh, plan, options, result);
    return mesh;
}

void collapse_to_target(Mesh& mesh, const DecimatePlan& plan, const SimplifyOptions& options, DecimateResult& result) {
    const std::size_t mesh_bytes = mesh.bytes();
    const CollapseResult done = collapse_edges(mesh, options, plan.last);
    add(result.verdicts, done.verdicts);
    result.refreshes += done.refreshes;
    result.stopped = done.stopped;
    result.bytes = std::max(result.bytes, mesh_bytes + done.bytes);
}

double trim_added(Mesh& mesh, const SimplifyOptions& options, StopReason stopped, VerdictCounts& verdicts) {
    if (stopped == StopReason::kTarget && mesh.face_count() > options.target_faces)
        add(verdicts, collapse_edges(mesh, options, {.threads = options.threads}).verdicts);
    return largest_error_bound(mesh);
}

}  // namespace regionmesh
