// The edges at a vertex, each with its labels.
#pragma once

#include <vector>

#include "mesh/label_set.h"
#include "regionmesh/mesh.h"

namespace regionmesh {

/// All edges at a vertex in one pass over its star. Keeps its memory from one vertex to the next.
class StarEdges {
public:
    void gather(const Mesh& mesh, VertexId v);

    /// The other ends, in the order in which the faces of the star name them.
    const std::vector<VertexId>& ends() const { return ends_; }
    /// One per end: edge_labels of the edge (mesh/strata.h).
    const std::vector<LabelSet>& labels() const { return labels_; }

private:
    std::vector<VertexId> ends_;
    std::vector<LabelSet> labels_;
    std::vector<int> uses_;  // one per end: number of sides of its faces
};

}  // namespace regionmesh
