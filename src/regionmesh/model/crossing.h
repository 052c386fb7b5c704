// Which faces meet outside what they share? (P test 6)
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "regionmesh/model/model.h"
#include "regionmesh/model/sorted_face_tree.h"
#include "regionmesh/model/star_crossing.h"

namespace regionmesh {

/// All pairs of faces that meet outside what they share, in order: exact. Faces without area meet none. The tree holds
/// all faces of the model.
std::vector<FacePair> find_crossings(const Model& model, const SortedFaceTree& tree, std::uint32_t threads);

}  // namespace regionmesh
