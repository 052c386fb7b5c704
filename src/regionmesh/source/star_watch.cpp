#include "regionmesh/source/star_watch.h"

#include <algorithm>

namespace regionmesh {

StarWatch::StarWatch(const StripOptions& options) {
    options_.boundary_is_open = !options.cap;
    options_.background = options.background;
}

/// All of the exterior is one here, and any vertex may be on the hull until it is judged.
void StarWatch::add(const MeshedStrip& strip) {
    std::uint32_t number = strip.first_vertex;
    for (const BatchVertex& vertex : strip.vertices) {
        const VertexId v = model_.add_vertex(vertex.position, kOnHull);
        if (index(v) >= numbers_.size()) {
            numbers_.resize(index(v) + 1);
            is_judged_.resize(index(v) + 1);
        }
        numbers_[index(v)] = number;
        is_judged_[index(v)] = false;
        ids_.emplace(number++, v);
    }
    for (const BatchFace& face : strip.faces) {
        std::array<VertexId, 3> corner;
        for (int n = 0; n < 3; ++n) corner[n] = ids_.at(face.vertices[n]);
        std::array<Label, 2> labels = face.labels;
        for (Label& label : labels)
            if (is_exterior(label)) label = exterior(kHull);
        model_.add_face(corner[0], corner[1], corner[2], labels[0], labels[1]);
    }
}

void StarWatch::judge(std::span<VertexEnd> ended) {
    GenericStar generic(model_, options_);
    for (VertexEnd& end : ended) {
        const VertexId v = ids_.at(end.vertex);
        model_[v].sides = end.is_on_hull ? kOnHull : SideSet{0};
        end.is_pinned = generic.fault(v) != StarFault::kNone;
        is_judged_[index(v)] = true;
    }
    for (const VertexEnd& end : ended)
        if (const auto found = ids_.find(end.vertex); found != ids_.end()) forget(found->second);
}

/// Takes out the faces of which no vertex needs any more, and the vertex if it has none then.
void StarWatch::forget(VertexId v) {
    std::vector<FaceId> done;
    std::vector<VertexId> corners{v};
    model_.for_star(v, [&](FaceId f, int) {
        const auto& vertices = model_[f].vertices;
        if (!std::ranges::all_of(vertices, [&](VertexId n) { return is_judged_[index(n)]; })) return;
        done.push_back(f);
        corners.insert(corners.end(), vertices.begin(), vertices.end());
    });
    for (FaceId f : done) model_.remove_face(f);
    std::sort(corners.begin(), corners.end());
    corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
    for (VertexId n : corners) {
        if (model_[n].star != kNoCorner || !is_judged_[index(n)]) continue;
        ids_.erase(numbers_[index(n)]);
        model_.remove_vertex(n);
    }
}

}  // namespace regionmesh
