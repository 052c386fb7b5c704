// Which faces meet outside what they share? (P test 6)
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "regionmesh/model/face_meeting.h"
#include "regionmesh/model/model.h"
#include "regionmesh/model/sorted_face_tree.h"
#include "regionmesh/model/star_crossing.h"

namespace regionmesh {

/// All pairs of faces that meet outside what they share, in order. Exact: no epsilon decides. Faces without area meet
/// none. The tree is the model's. The threads (parallel_for) change nothing.
std::vector<FacePair> find_crossings(const Model& model, const SortedFaceTree& tree, std::uint32_t threads);

/// The same for a list of faces, wherever they come from; they are named by their places in it.
std::vector<FacePair> find_crossings(std::span<const LabelledFace> faces, std::uint32_t threads);

}  // namespace regionmesh
