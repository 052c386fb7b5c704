#include "regionmesh/stream/weld.h"

#include <cassert>

namespace regionmesh {

void Weld::add(const FaceBatch& batch) {
    assert(batch.carried == front_.size());
    ids_ = front_;
    for (VertexId v : front_) model_[v].is_fixed = false;
    for (const BatchVertex& vertex : batch.vertices) ids_.push_back(model_.add_vertex(vertex.position, vertex.sides));
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

void Weld::renumber(const std::vector<VertexId>& new_ids) {
    for (VertexId& v : front_) v = new_ids[index(v)];
}

}  // namespace regionmesh
