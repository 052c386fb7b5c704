#include "stream/stage_options.h"

#include "stream/tuning.h"

namespace regionmesh {

ReconstructOptions with_filter(const ReconstructOptions& options, SmoothFilter automatic) {
    ReconstructOptions own = options;
    if (own.smooth.filter == SmoothFilter::kAuto) own.smooth.filter = automatic;
    return own;
}

CellKind cell_kind(const ReconstructOptions& options) {
    if (options.cells != CellKind::kAuto) return options.cells;
    const SmoothFilter filter = options.smooth.filter;
    const bool keeps_samples =
        options.smooth.passes == 0 || filter == SmoothFilter::kAuto || filter == SmoothFilter::kLattice;
    return keeps_samples && !options.preserve_volume ? CellKind::kCompact : CellKind::kTetrahedra;
}

SmoothOptions smooth_options(const ReconstructOptions& options, double scale) {
    SmoothOptions own = options.smooth;
    own.scale = scale;
    own.min_quality = options.min_quality;
    own.intersect_check = options.intersect_check;
    own.threads = options.threads;
    return own;
}

SimplifyOptions simplify_options(const ReconstructOptions& options, const SourceShape& shape) {
    SimplifyOptions own;
    if (options.max_error) own.max_error = *options.max_error;
    own.min_quality = options.min_quality * (options.preserve_volume ? stream::kQualityMargin : 1);
    own.perturbation = options.perturbation;
    own.scale = shape.scale;
    own.intersect_check = options.intersect_check;
    if (options.keep_samples && shape.has_samples) own.samples = shape.lattice;
    own.placement = options.placement;
    return own;
}

}  // namespace regionmesh
