// Do two faces meet outside the vertices that they share? (P test 6)
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "regionmesh/ids.h"
#include "regionmesh/label.h"
#include "regionmesh/vec3.h"

namespace regionmesh {

/// A face with the positions of its corners. Faces share what has the same vertex ids.
struct PlacedFace {
    std::array<VertexId, 3> vertices;
    std::array<Vec3, 3> at;
};

/// A face with labels.
struct LabelledFace {
    PlacedFace placed;
    std::array<Label, 2> labels;  // the normal points from the first to the second
};

/// The sum of the absolute coordinates: no less than the length.
inline double size_of(Vec3 a) { return std::abs(a.x) + std::abs(a.y) + std::abs(a.z); }

/// Do the bounding boxes of two triangles overlap or touch?
inline bool boxes_overlap(const std::array<Vec3, 3>& p, const std::array<Vec3, 3>& q) {
    for (int axis = 0; axis < 3; ++axis) {
        if (std::min({p[0][axis], p[1][axis], p[2][axis]}) > std::max({q[0][axis], q[1][axis], q[2][axis]}))
            return false;
        if (std::max({p[0][axis], p[1][axis], p[2][axis]}) < std::min({q[0][axis], q[1][axis], q[2][axis]}))
            return false;
    }
    return true;
}

/// Do the faces have a common vertex?
inline bool share_vertex(const std::array<VertexId, 3>& v, const std::array<VertexId, 3>& w) {
    bool share = false;  // no branches: they would be mispredicted
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) share |= v[i] == w[j];
    return share;
}

/// A cheap proof that two triangles do not meet: a separating plane, perpendicular to the line through their centroids
/// or to a face diagonal of a cube. About 1 % of the pairs with overlapping boxes are left undecided.
bool are_apart(const std::array<Vec3, 3>& p, const std::array<Vec3, 3>& q);

/// Do the faces meet outside shared vertices and edges, or share all three vertices? Exact. Requires that neither is
/// degenerate.
bool meet_outside_shared(const PlacedFace& f, const PlacedFace& g);

}  // namespace regionmesh
