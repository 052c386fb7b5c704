#include "stream/star_watch.h"

#include <algorithm>

namespace regionmesh {

StarWatch::StarWatch(const StripOptions& options) {
    options_.boundary_is_open = !options.cap;
    options_.background = options.background;
}

/// All exterior labels are one here, and any vertex may be on the hull until it is judged.
void StarWatch::add(const MeshedStrip& strip) {
    std::uint32_t number = strip.first_vertex;
    for (const ChunkVertex& vertex : strip.vertices) {
        ids_.emplace(number, mesh_.add_vertex(vertex.position, kOnHull));
        numbers_.push_back(number++);
        is_judged_.push_back(false);
    }
    for (const ChunkFace& face : strip.faces) {
        std::array<VertexId, 3> corner;
        for (int n = 0; n < 3; ++n) corner[n] = ids_.at(face.vertices[n]);
        std::array<Label, 2> labels = face.labels;
        for (Label& label : labels)
            if (is_exterior(label)) label = exterior(kHull);
        mesh_.add_face(corner[0], corner[1], corner[2], labels[0], labels[1]);
    }
}

void StarWatch::judge(std::span<FinalizedVertex> finalized) {
    GenericStar generic(mesh_, options_);
    for (FinalizedVertex& end : finalized) {
        const VertexId v = ids_.at(end.vertex);
        mesh_[v].sides = end.is_on_hull ? kOnHull : SideSet{0};
        end.is_pinned = generic.fault(v) != StarFault::kNone;
        is_judged_[index(v)] = true;
    }
    judged_ += static_cast<std::uint32_t>(finalized.size());
    if (2 * judged_ > mesh_.vertex_count()) pack();
}

void StarWatch::pack() {
    const Mesh before = std::move(mesh_);
    const std::vector<std::uint32_t> numbers = std::move(numbers_);
    const std::vector<bool> was_judged = std::move(is_judged_);
    mesh_ = {};
    numbers_.clear();
    is_judged_.clear();
    ids_.clear();
    judged_ = 0;
    const auto keep = [&](VertexId v) {
        const std::uint32_t number = numbers[index(v)];
        if (const auto found = ids_.find(number); found != ids_.end()) return found->second;
        numbers_.push_back(number);
        is_judged_.push_back(was_judged[index(v)]);
        judged_ += was_judged[index(v)];
        return ids_.emplace(number, mesh_.add_vertex(before.position(v), before[v].sides)).first->second;
    };
    for (std::uint32_t f = 0; f < before.face_end(); ++f) {
        const auto& [corners, next, labels] = before[FaceId{f}];
        if (std::ranges::all_of(corners, [&](VertexId v) { return was_judged[index(v)]; })) continue;
        const VertexId a = keep(corners[0]), b = keep(corners[1]), c = keep(corners[2]);
        mesh_.add_face(a, b, c, labels[0], labels[1]);
    }
    for (std::uint32_t v = 0; v < before.vertex_end(); ++v)
        if (!was_judged[v]) keep(VertexId{v});
}

}  // namespace regionmesh
