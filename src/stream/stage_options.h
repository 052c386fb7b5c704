// What a run's options say to its stages.
#pragma once

#include "regionmesh/reconstruct.h"
#include "regionmesh/simplify.h"

namespace regionmesh {

SmoothOptions smooth_options(const ReconstructOptions& options, double scale);

/// Without target and limits.
DecimateOptions decimate_options(const ReconstructOptions& options, double scale);

}  // namespace regionmesh
