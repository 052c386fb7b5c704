#include "stream/memory_demand.h"

#include <algorithm>

namespace regionmesh {
namespace {

/// Bytes a face that smoothing holds, with half a vertex; and more for the stars and normals of nifpms.
constexpr std::uint64_t kWindowBytes = 90, kNifpmsBytes = 70;

/// Runs are not cut shorter than this: their tiles would be nearly all rim.
constexpr std::uint32_t kFewestStrips = 4;

/// Tiles may leave so much of a run, whatever the target. Mostly it is a seventh to a third; of noise it is more.
constexpr double kLeftByTiles = 0.5;

/// Where faces reach far ahead, tiles may find little to do beside those of the run before.
constexpr double kLeftBesideLongFaces = 0.99;

}  // namespace

bool is_decimating(const ReconstructOptions& options) {
    return options.decimate && (options.target_faces || options.reduce || options.max_error);
}

MemoryDemand memory_demand(const ReconstructOptions& options, const Target& target, RunSize size) {
    MemoryDemand demand{.source = size.shape.name,
                        .lattice = size.shape.lattice,
                        .sweep = size.shape.sweep,
                        .reading_bytes = size.shape.reading_bytes,
                        .strip_faces = std::move(size.strip_faces),
                        .window_strips = size.window_strips,
                        .run_strips = size.run_strips,
                        .fewest_run_strips = size.run_strips};
    demand.window_bytes_per_face = kWindowBytes + (options.smooth.filter == SmoothFilter::kNifpms ? kNifpmsBytes : 0);
    demand.is_decimating = is_decimating(options);
    demand.preserves_volume = options.preserve_volume;
    demand.asked_budget = options.face_budget;
    const bool is_counted = !demand.strip_faces.empty();
    if (!is_counted) demand.strip_faces = guessed_strip_faces(size.shape.lattice, size.shape.sweep);
    if (!demand.is_decimating) {
        // What the model will be is not asked of a guess: it may be far too much.
        demand.target_share = is_counted ? 1 : 0;
        return demand;
    }
    demand.fewest_run_strips = std::min(size.run_strips, kFewestStrips);
    demand.target_share = is_counted ? std::min(target.share(), 1.0) : 0;
    const double left = size.shape.strip_overlap > 0 ? kLeftBesideLongFaces : kLeftByTiles;
    if (const double share = target.share() * kTileMargin; share < 1) demand.tile_share = std::max(share, left);
    return demand;
}

}  // namespace regionmesh
