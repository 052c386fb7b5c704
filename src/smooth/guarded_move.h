// New places for the vertices of a model, as far as the guard allows.
#pragma once

#include <cstdint>
#include <vector>

#include "regionmesh/mesh.h"
#include "regionmesh/smooth_options.h"

namespace regionmesh {

/// Moves every vertex to `to[v]`, or part of the way there where a face would turn over, fall below the quality bound
/// or cross another. Returns the level that each vertex has stepped back to (smooth/step_back.h). Uses min_quality,
/// intersect_check and threads of the options.
std::vector<std::uint8_t> move_guarded(Mesh& mesh, const std::vector<Vec3>& to, const SmoothOptions& options);

}  // namespace regionmesh
