// Splits of edges: the way out for a face that lines and sides hold on all corners.
#pragma once

#include "improve/surface_drift.h"
#include "judge/judge.h"

namespace regionmesh {

/// Tries faces one by one. Holds the scratch space of their tests. Requires Vertex::label_count (count_labels).
class EdgeSplits {
public:
    EdgeSplits(Judge& judge, SurfaceDrift& drift) : judge_(judge), mesh_(judge.mesh()), drift_(drift) {}

    /// Splits the longest edge of the face, at the foot of the height on it or in the middle, where that makes the
    /// faces at the edge better and no test refuses it. The surface stays where it is.
    bool try_split(FaceId f);

private:
    Judge& judge_;
    const Mesh& mesh_;
    SurfaceDrift& drift_;
    Change change_;
};

}  // namespace regionmesh
