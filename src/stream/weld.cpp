#include "stream/weld.h"

#include <cassert>

namespace regionmesh {

void Weld::add(const Chunk& batch) {
    assert(batch.carried == front_.size());
    ids_ = front_;
    const auto is_pinned = [](SideSet sides) { return (sides & kPinned) != 0; };
    for (VertexId v : front_) mesh_[v].is_fixed = is_pinned(mesh_[v].sides);
    for (const ChunkVertex& vertex : batch.vertices)
        ids_.push_back(mesh_.add_vertex(vertex.position, vertex.sides, is_pinned(vertex.sides)));
    for (const ChunkFace& face : batch.faces)
        mesh_.add_face(ids_[face.vertices[0]], ids_[face.vertices[1]], ids_[face.vertices[2]], face.labels[0],
                       face.labels[1]);
    front_.clear();
    for (std::uint32_t local : batch.open) front_.push_back(ids_[local]);
    for (VertexId v : front_) mesh_[v].is_fixed = true;
}

std::vector<ChunkVertex> Weld::front() const {
    std::vector<ChunkVertex> vertices;
    for (VertexId v : front_) vertices.push_back({mesh_[v].position, mesh_[v].sides});
    return vertices;
}

Chunk Weld::take_apart() {
    Chunk batch;
    std::vector<std::uint32_t> locals(mesh_.vertex_end());
    batch.vertices.reserve(mesh_.vertex_count());
    for (std::uint32_t v = 0; v < mesh_.vertex_end(); ++v) {
        const Vertex& vertex = mesh_[VertexId{v}];
        if (!vertex.is_alive) continue;
        locals[v] = static_cast<std::uint32_t>(batch.vertices.size());
        batch.vertices.push_back({vertex.position, vertex.sides});
    }
    batch.faces.reserve(mesh_.face_count());
    for (std::uint32_t f = 0; f < mesh_.face_end(); ++f) {
        if (!mesh_.is_alive(FaceId{f})) continue;
        const auto& corners = mesh_[FaceId{f}].vertices;
        batch.faces.push_back({{locals[index(corners[0])], locals[index(corners[1])], locals[index(corners[2])]},
                               mesh_[FaceId{f}].labels});
    }
    for (VertexId v : front_) batch.open.push_back(locals[index(v)]);
    front_.clear();
    mesh_ = {};
    return batch;
}

std::uint64_t Weld::release_all() {
    std::uint64_t pinned = 0;
    for (std::uint32_t v = 0; v < mesh_.vertex_end(); ++v) {
        Vertex& vertex = mesh_[VertexId{v}];
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
