// Finds faces that meet outside shared vertices and edges (P test 6).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/face_meeting.h"
#include "mesh/sorted_face_tree.h"
#include "mesh/star_crossing.h"
#include "regionmesh/mesh.h"

namespace regionmesh {

/// All pairs of faces that meet outside shared vertices and edges, in order. Exact: no epsilon. Faces without area are
/// left out. `tree` is that of the mesh. The result does not depend on `threads` (parallel_for).
std::vector<FacePair> find_crossings(const Mesh& mesh, const SortedFaceTree& tree, std::uint32_t threads);

/// Crossing pairs of faces that share no vertex.
std::vector<FacePair> find_crossings_apart(const Mesh& mesh, const SortedFaceTree& tree, std::uint32_t threads);

/// The same for a list of faces from any source; results are positions in the list.
std::vector<FacePair> find_crossings(std::span<const LabelledFace> faces, std::uint32_t threads);

}  // namespace regionmesh
