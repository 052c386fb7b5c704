#include "stream/stage_options.h"

#include "stream/tuning.h"

namespace regionmesh {

ReconstructOptions with_filter(const ReconstructOptions& options, SmoothFilter automatic) {
    ReconstructOptions own = options;
    if (own.smooth.filter == SmoothFilter::kAuto) own.smooth.filter = automatic;
    return own;
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
