#include "check/generic_star.h"

#include <algorithm>

#include "mesh/box_sides.h"
#include "mesh/strata.h"

namespace regionmesh {
namespace {

constexpr int kMostLabels = 4;

/// Vertices with more faces are not examined: ordering a fan takes time proportional to the square of the number.
constexpr int kMostStarFaces = 4096;

}  // namespace

StarFault GenericStar::fault(VertexId v) {
    bool is_odd = false;
    int faces = 0;
    mesh_.for_star(v, [&](FaceId f, int) {
        is_odd |= mesh_[f].labels[0] == mesh_[f].labels[1];
        ++faces;
    });
    const LabelSet labels = vertex_labels(mesh_, v);
    if (is_odd || faces == 0 || labels.size() > kMostLabels) return StarFault::kLabels;
    if (faces > kMostStarFaces) return StarFault::kSize;
    for (Label label : labels) {
        if (is_exterior(label)) continue;
        if (!has_one_fan(v, label)) return StarFault::kFans;
        // The two regions of an interface have the same faces.
        if (labels.size() == 2) return StarFault::kNone;
    }
    edges_.gather(mesh_, v);
    return look_at_lines(v, labels.size(), edges_);
}

StarFault GenericStar::fault_of_fans(VertexId v, int labels, const StarEdges& edges) {
    if (labels > kMostLabels) return StarFault::kLabels;
    return labels < 3 ? StarFault::kNone : look_at_lines(v, labels, edges);
}

bool GenericStar::has_one_fan(VertexId v, Label label) {
    fan_.clear();
    mesh_.for_star(v, [&](FaceId f, int place) {
        const Face& face = mesh_[f];
        const VertexId a = face.vertices[place_after(place)], b = face.vertices[place_before(place)];
        if (face.labels[0] == label)
            fan_.push_back({a, b, index(f)});
        else if (face.labels[1] == label)
            fan_.push_back({b, a, index(f)});
    });
    if (!order_fan(fan_)) return false;
    if (is_closed(fan_)) return fan_.size() >= 3;
    return may_be_open(label, v, fan_.front().first, FaceId{fan_.front().name}) &&
           may_be_open(label, v, fan_.back().second, FaceId{fan_.back().name});
}

/// May the face be the only one of the label at the edge?
bool GenericStar::may_be_open(Label label, VertexId v, VertexId end, FaceId face) const {
    return open_sides(mesh_[v].sides & mesh_[end].sides, mesh_[face].labels) != 0 &&
           (options_.boundary_is_open || options_.is_background(label));
}

StarFault GenericStar::look_at_lines(VertexId v, int labels, const StarEdges& edges) {
    triples_.clear();
    for (const LabelSet& at_edge : edges.labels()) {
        if (at_edge.size() > 3) return StarFault::kPages;
        if (at_edge.size() < 3) continue;
        std::array<Label, 3>& triple = triples_.emplace_back();
        std::partial_sort_copy(at_edge.begin(), at_edge.end(), triple.begin(), triple.end());
    }
    const std::size_t lines = triples_.size();
    if (labels == 3) return lines == 2 ? StarFault::kNone : StarFault::kLines;
    std::sort(triples_.begin(), triples_.end());
    const bool repeats = std::adjacent_find(triples_.begin(), triples_.end()) != triples_.end();
    // Corner of the box: three sides meet without a line that has faces; so does a label without faces there.
    const bool is_right = mesh_[v].sides == 0 ? lines == 4 : lines >= 2;
    return is_right && !repeats ? StarFault::kNone : StarFault::kLines;
}

}  // namespace regionmesh
