// Which faces meet outside what they share? (P test 6)
#pragma once

#include <cstdint>
#include <vector>

#include "regionmesh/model/model.h"
#include "regionmesh/model/sorted_face_tree.h"
#include "regionmesh/model/star_crossing.h"

namespace regionmesh {

/// All pairs of faces that meet outside what they share, in order. Exact: no epsilon decides. Faces without area meet
/// none. The tree holds all faces of the model. The threads change nothing (parallel_for).
std::vector<FacePair> find_crossings(const Model& model, const SortedFaceTree& tree, std::uint32_t threads);

/// The same among some of the faces, all of them alive and different: those of a window that moved, say. Time and memory
/// go with their number, not with the model's.
std::vector<FacePair> find_crossings(const Model& model, const std::vector<FaceId>& faces, std::uint32_t threads);

}  // namespace regionmesh
