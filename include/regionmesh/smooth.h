// Smooths a mesh in core.
#pragma once

#include "regionmesh/mesh.h"
#include "regionmesh/smooth_options.h"
#include "regionmesh/smooth_report.h"

namespace regionmesh {

/// Moves the vertices in place, except fixed ones; ids stay. Passes and guard are those of reconstruct(). Violations
/// that the mesh has before may stay; no new ones are added. Deterministic.
SmoothReport smooth(Mesh& mesh, const SmoothOptions& options);

}  // namespace regionmesh
