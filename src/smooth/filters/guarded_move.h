// Moves the vertices of a mesh to new positions, as far as the guard allows.
#pragma once

#include <cstdint>
#include <vector>

#include "regionmesh/mesh.h"
#include "regionmesh/smooth.h"

namespace regionmesh {

/// Moves every vertex to `to[v]`, or part of the way there where a face would turn over, fall below the quality bound
/// or cross another. Returns the steps that each vertex backtracked, 0 to kFullBacktrack (smooth/filters/backtrack.h).
/// Uses min_quality, intersect_check and threads of the options.
std::vector<std::uint8_t> move_guarded(Mesh& mesh, const std::vector<Vec3>& to, const SmoothOptions& options);

}  // namespace regionmesh
