#include "stream/run_promises.h"

#include <algorithm>

#include "base/option_range.h"
#include "stream/tuning.h"

namespace regionmesh {

Ground ground_of(const SourceShape& shape) {
    Ground ground{.scale = shape.scale, .scale_z = shape.scale_z};
    if (!shape.has_samples) return ground;
    ground.samples = shape.lattice.along_axes();  // meshes are turned at the end
    ground.box = ground.samples->extent();
    ground.spacing = shape.lattice.spacing;
    return ground;
}

double quality_bound(const ReconstructOptions& options, const Ground& ground) {
    // Faces are improved for the sake of their shape; volumes are restored by moving vertices, which bad faces hold
    // back.
    const bool is_usual = options.promises.min_quality || !ground.spacing || options.improve || options.preserve_volume;
    return is_usual ? options.promises.quality_bound() : usual_quality_bound(*ground.spacing);
}

Promises promises_of(const ReconstructOptions& options, const Ground& ground) {
    Promises promises = options.promises;
    promises.min_quality = quality_bound(options, ground);
    if (options.preserve_volume)
        promises.min_quality = std::min(*promises.min_quality * stream::kQualityMargin, kQualityRange.most);
    if (options.keep_samples) promises.samples = ground.samples;
    promises.box = ground.box;
    promises.scale = ground.scale;
    promises.scale_z = ground.scale_z;
    return promises;
}

SimplifyOptions simplify_options(const ReconstructOptions& options, const Promises& promises) {
    return {.promises = promises,
            .perturbation = options.perturbation,
            .placement = options.placement,
            .threads = options.threads};
}

SmoothOptions smooth_options(const ReconstructOptions& options, double scale) {
    SmoothOptions own = options.smooth;
    own.scale = scale;
    own.min_quality = options.promises.quality_bound();
    own.intersect_check = options.promises.intersect_check;
    own.threads = options.threads;
    return own;
}

}  // namespace regionmesh
