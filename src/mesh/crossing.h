// Which faces meet outside what they share? (P test 6)
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/face_meeting.h"
#include "mesh/sorted_face_tree.h"
#include "mesh/star_crossing.h"
#include "regionmesh/mesh.h"

namespace regionmesh {

/// All pairs of faces that meet outside what they share, in order. Exact: no epsilon decides. Faces without area meet
/// none. The tree is the model's. The threads (parallel_for) change nothing.
std::vector<FacePair> find_crossings(const Mesh& mesh, const SortedFaceTree& tree, std::uint32_t threads);

/// The same for a list of faces, wherever they come from; they are named by their places in it.
std::vector<FacePair> find_crossings(std::span<const LabelledFace> faces, std::uint32_t threads);

}  // namespace regionmesh
