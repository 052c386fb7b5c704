#include "regionmesh/stream/weld.h"

#include <cassert>

namespace regionmesh {

void Weld::add(const FaceBatch& batch) {
    assert(batch.carried == front_.size());
    ids_ = front_;
    const auto is_pinned = [](SideSet sides) { return (sides & kPinned) != 0; };
    for (VertexId v : front_) model_[v].is_fixed = is_pinned(model_[v].sides);
    for (const BatchVertex& vertex : batch.vertices)
        ids_.push_back(model_.add_vertex(vertex.position, vertex.sides, is_pinned(vertex.sides)));
    for (const BatchFace& face : batch.faces)
        model_.add_face(ids_[face.vertices[0]], ids_[face.vertices[1]], ids_[face.vertices[2]], face.labels[0],
                        face.labels[1]);
    front_.clear();
    for (std::uint32_t local : batch.open) front_.push_back(ids_[local]);
    for (VertexId v : front_) model_[v].is_fixed = true;
}

std::vector<BatchVertex> Weld::front() const {
    std::vector<BatchVertex> vertices;
    for (VertexId v : front_) vertices.push_back({model_[v].position, model_[v].sides});
    return vertices;
}

FaceBatch Weld::take_apart() {
    FaceBatch batch;
    std::vector<std::uint32_t> locals(model_.vertex_end());
    batch.vertices.reserve(model_.vertex_count());
    for (std::uint32_t v = 0; v < model_.vertex_end(); ++v) {
        const Vertex& vertex = model_[VertexId{v}];
        if (!vertex.is_alive) continue;
        locals[v] = static_cast<std::uint32_t>(batch.vertices.size());
        batch.vertices.push_back({vertex.position, vertex.sides});
    }
    batch.faces.reserve(model_.face_count());
    for (std::uint32_t f = 0; f < model_.face_end(); ++f) {
        if (!model_.is_alive(FaceId{f})) continue;
        const auto& corners = model_[FaceId{f}].vertices;
        batch.faces.push_back({{locals[index(corners[0])], locals[index(corners[1])], locals[index(corners[2])]},
                               model_[FaceId{f}].labels});
    }
    for (VertexId v : front_) batch.open.push_back(locals[index(v)]);
    front_.clear();
    model_ = {};
    return batch;
}

std::uint64_t Weld::release_all() {
    std::uint64_t pinned = 0;
    for (std::uint32_t v = 0; v < model_.vertex_end(); ++v) {
        Vertex& vertex = model_[VertexId{v}];
        pinned += vertex.is_alive && (vertex.sides & kPinned) != 0;
        vertex.is_fixed = false;
        vertex.sides &= static_cast<SideSet>(~kPinned);
    }
    return pinned;
}

void Weld::renumber(const std::vector<VertexId>& new_ids) {
    for (VertexId& v : front_) v = new_ids[index(v)];
}

}  // namespace regionmesh
