#include "mesh/star_edges.h"

#include <algorithm>

#include "mesh/strata.h"

namespace regionmesh {

void StarEdges::gather(const Mesh& mesh, VertexId v) {
    ends_.clear();
    labels_.clear();
    uses_.clear();
    mesh.for_star(v, [&](FaceId f, int place) {
        const Face& face = mesh[f];
        for (VertexId end : {face.vertices[place_after(place)], face.vertices[place_before(place)]}) {
            std::size_t at = ends_.size();
            for (std::size_t n = 0; n < ends_.size(); ++n) at = ends_[n] == end ? n : at;  // no branch: mispredicted
            if (at == ends_.size()) {
                ends_.push_back(end);
                labels_.emplace_back();
                uses_.push_back(0);
            }
            for (Label label : face.labels) labels_[at].add(label);
            uses_[at] += 2;
        }
    });
    // Sides count, too, where the surface ends.
    for (std::size_t n = 0; n < ends_.size(); ++n)
        if (uses_[n] < 2 * labels_[n].size()) labels_[n] = edge_labels(mesh, v, ends_[n]);
}

}  // namespace regionmesh
