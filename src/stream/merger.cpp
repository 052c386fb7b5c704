#include "stream/merger.h"

#include <algorithm>
#include <cassert>

#include "simplify/mesh_chunk.h"

namespace regionmesh {

void Merger::add(const Chunk& chunk) {
    assert(chunk.carried == active_.size());
    ids_ = active_;
    for (std::size_t n = 0; n < chunk.carried_bounds.size(); ++n) {
        Vertex& vertex = mesh_[active_[n]];
        vertex.set_error_bound(std::max(vertex.error_bound(), chunk.carried_bounds[n]));
    }
    const auto is_pinned = [](SideSet sides) { return (sides & kPinned) != 0; };
    for (VertexId v : active_) mesh_[v].is_fixed = is_pinned(mesh_[v].sides);
    for (const ChunkVertex& vertex : chunk.vertices) {
        ids_.push_back(mesh_.add_vertex(vertex.position, vertex.sides, is_pinned(vertex.sides)));
        mesh_[ids_.back()].set_error_bound(vertex.error_bound);
    }
    for (const ChunkFace& face : chunk.faces)
        mesh_.add_face(ids_[face.vertices[0]], ids_[face.vertices[1]], ids_[face.vertices[2]], face.labels[0],
                       face.labels[1]);
    active_.clear();
    for (std::uint32_t local : chunk.active) active_.push_back(ids_[local]);
    for (VertexId v : active_) mesh_[v].is_fixed = true;
}

Chunk Merger::take_apart() {
    Chunk chunk = take_chunk(mesh_, active_);
    active_.clear();
    return chunk;
}

std::uint64_t Merger::release_all() {
    std::uint64_t pinned = 0;
    for (std::uint32_t v = 0; v < mesh_.vertex_end(); ++v) {
        Vertex& vertex = mesh_[VertexId{v}];
        pinned += vertex.is_alive && (vertex.sides & kPinned) != 0;
        vertex.is_fixed = false;
        vertex.sides &= static_cast<SideSet>(~kPinned);
    }
    return pinned;
}

void Merger::renumber(const std::vector<VertexId>& new_ids) {
    for (VertexId& v : active_) v = new_ids[index(v)];
}

}  // namespace regionmesh
