// Which sides of faces hang together?
#pragma once

#include <vector>

#include "base/union_find.h"
#include "regionmesh/mesh.h"

namespace regionmesh {

/// The label of a side, all six sides of the exterior being one.
inline Label label_of_side(const Mesh& mesh, std::uint32_t side) {
    const Label label = mesh[FaceId{side >> 1}].labels[side & 1];
    return is_exterior(label) ? exterior(0) : label;
}

/// Joins sides 2 f + k of faces (k: first or second label) across the edges round which their label goes on: two of a
/// label at an edge; of more, those between which the label lies. Returns, by side, whether its label ends at one of
/// its edges without going on.
std::vector<bool> join_sides(const Mesh& mesh, UnionFind& joined);

}  // namespace regionmesh
