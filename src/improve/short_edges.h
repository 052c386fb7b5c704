// Collapses of short edges: the way out for a face that no flip and no move makes better.
#pragma once

#include <optional>
#include <vector>

#include "improve/surface_drift.h"
#include "judge/judge.h"

namespace regionmesh {

/// Tries faces one by one. Holds the scratch space of their tests. Requires Vertex::label_count (count_labels).
class ShortEdges {
public:
    ShortEdges(Judge& judge, SurfaceDrift& drift);

    /// Collapses an edge of the face, the shortest first, where that makes the faces around better and no test refuses
    /// it. The merged vertex and those around it are then those of changed().
    bool try_collapse(FaceId f);
    const std::vector<VertexId>& changed() const { return changed_; }

private:
    bool try_edge(VertexId goes, VertexId stays);
    bool try_place(Vec3 p);

    Judge& judge_;
    const Mesh& mesh_;
    SurfaceDrift& drift_;
    Change change_;
    std::vector<VertexId> changed_;
};

}  // namespace regionmesh
