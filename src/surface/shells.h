// Connected components of the sides of faces.
#pragma once

#include <vector>

#include "base/union_find.h"
#include "regionmesh/mesh.h"

namespace regionmesh {

/// The label of a side; all six exteriors count as one.
inline Label label_of_side(const Mesh& mesh, std::uint32_t side) {
    const Label label = mesh[FaceId{side >> 1}].labels[side & 1];
    return is_exterior(label) ? exterior(0) : label;
}

/// Joins sides 2 f + k of faces (k: first or second label) across edges where the boundary of their label continues:
/// the two sides of a label at an edge; if there are more, those with the label between them. Returns, by side, whether
/// the boundary ends at one of its edges.
std::vector<bool> join_sides(const Mesh& mesh, UnionFind& joined);

}  // namespace regionmesh
