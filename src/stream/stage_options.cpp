#include "stream/stage_options.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/option_range.h"
#include "regionmesh/error.h"
#include "regionmesh/limits.h"
#include "smooth/chunk_smoother.h"
#include "stream/run_promises.h"
#include "volume/exact_grid.h"
#include "volume/room_reader.h"

namespace regionmesh {

void require_in_range(const ReconstructOptions& options) {
    if (options.reduce) require_number("reduce", *options.reduce, {0, 1, "0 to 1"});
    require_in_range(options.promises);
    require_room(options.room);
    require_in_range(options.denoise);
    require_choice("cells", options.cells, CellKind::kTetrahedra);
    require_choice("placement", options.placement, PlacementKind::kLindstromTurk);
    if (options.strips_per_chunk == 0) throw Error(ErrorCode::kUsage, "strips_per_chunk: 0; give at least 1");
    require_number("perturbation", options.perturbation, kNotNegative);
    require_in_range(smooth_options(options, 1));
}

ReconstructOptions with_filter(const ReconstructOptions& options, SmoothFilter automatic) {
    ReconstructOptions own = options;
    if (own.smooth.filter == SmoothFilter::kAuto) own.smooth.filter = automatic;
    return own;
}

bool is_lattice(SmoothFilter filter) { return filter == SmoothFilter::kAuto || filter == SmoothFilter::kLattice; }

CellKind cell_kind(const ReconstructOptions& options) {
    if (options.cells != CellKind::kAuto) return options.cells;
    const bool keeps_samples = options.smooth.passes == 0 || is_lattice(options.smooth.filter);
    return keeps_samples && !options.preserve_volume ? CellKind::kCompact : CellKind::kTetrahedra;
}

DenoiseOptions denoise_options(const ReconstructOptions& options) {
    DenoiseOptions own = options.denoise;
    own.threads = options.threads;
    own.memory = options.face_budget ? 0 : options.memory;
    return own;
}

double section_scale(const VolumeInfo& volume, const ReconstructOptions& options) {
    if (options.scale_z == kAutoScale) {
        const Vec3& spacing = volume.lattice.spacing;
        return nearest_power_of_two(std::sqrt(spacing.x * spacing.y) / spacing.z);
    }
    if (options.scale_z >= kLeastLength && options.scale_z <= 1 / kLeastLength)
        return nearest_power_of_two(options.scale_z);
    throw Error(ErrorCode::kUsage,
                volume.source + ": --scale-z must be a number above 0, and within bounds; take one such as 100");
}

SimplifyOptions simplify_options(const ReconstructOptions& options, const SourceShape& shape) {
    Promises promises = promises_of(options, ground_of(shape));
    const bool has_target = options.target_faces || options.reduce || promises.max_error < HUGE_VAL;
    if (!has_target && options.free_error > 0) promises.max_error = options.free_error;
    SimplifyOptions own = simplify_options(options, promises);
    // If the hull is open, a line may leave a domain that is not convex and come back in another region.
    own.bounds_regions = options.cap || shape.has_samples;
    own.removes_folds = shape.has_samples && options.smooth.passes > 0 && is_lattice(options.smooth.filter);
    return own;
}

}  // namespace regionmesh
