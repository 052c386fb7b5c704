// The options of the stages, from those of the run.
#pragma once

#include "regionmesh/reconstruct.h"
#include "stream/face_source.h"
#include "stream/run_promises.h"

namespace regionmesh {

/// Throws Error(kUsage) for numbers out of range, NaN among them.
void require_in_range(const ReconstructOptions& options);

/// The options with the filter that kAuto stands for.
ReconstructOptions with_filter(const ReconstructOptions& options, SmoothFilter automatic);

/// Are sections smoothed inside the lattice, which keeps every sample? kAuto is this filter, too.
bool is_lattice(SmoothFilter filter);

/// For the sections of a run.
DenoiseOptions denoise_options(const ReconstructOptions& options);

/// The factor of z of sections that the options ask for: a power of two, so that scaling is exact. Throws Error(kUsage)
/// for one out of bounds.
double section_scale(const VolumeInfo& volume, const ReconstructOptions& options);

/// Of a run: its promises, without a target.
SimplifyOptions simplify_options(const ReconstructOptions& options, const SourceShape& shape);

}  // namespace regionmesh
