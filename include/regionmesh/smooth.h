// Smoothing of a model that is wholly in core.
#pragma once

#include "regionmesh/mesh.h"
#include "regionmesh/smooth_options.h"
#include "regionmesh/smooth_report.h"

namespace regionmesh {

/// Moves the vertices in place, but for fixed ones; ids stay. The same passes and the same guard as in the stream. A
/// model that has faults keeps them where it cannot do better. Deterministic.
SmoothReport smooth(Mesh& mesh, const SmoothOptions& options);

}  // namespace regionmesh
