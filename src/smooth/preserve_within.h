// Volumes of regions, kept within an error.
#pragma once

#include "regionmesh/smooth.h"

namespace regionmesh {

/// preserve_volumes() by steps after which no error bound of a vertex (Vertex::error_bound) exceeds `max_error`, unless
/// it did before: a length, or infinity. Regions may stay off their volumes for it.
PreserveReport preserve_volumes_within(Mesh& mesh, const WantedVolumes& wanted, const SmoothOptions& options,
                                       double max_error);

}  // namespace regionmesh
