#include "stream/merger.h"

#include <utility>

#include "regionmesh/limits.h"
#include "simplify/mesh_chunk.h"

namespace regionmesh {

void Merger::add(Chunk chunk) {
    vertex_count_ += chunk.vertices.size();
    face_count_ += chunk.faces.size();
    require_mesh_size("mesh", vertex_count_, face_count_);
    chunks_.push_back(std::move(chunk));
}

std::uint32_t Merger::active_count() const {
    return chunks_.empty() ? 0 : static_cast<std::uint32_t>(chunks_.back().active.size());
}

std::size_t Merger::bytes() const { return vertex_count_ * sizeof(ChunkVertex) + face_count_ * sizeof(ChunkFace); }

std::vector<Chunk> Merger::take_chunks() {
    vertex_count_ = face_count_ = 0;
    return std::exchange(chunks_, {});
}

Chunk Merger::take_chunk() {
    const std::uint64_t vertex_count = vertex_count_, face_count = face_count_;
    std::vector<Chunk> chunks = take_chunks();
    if (chunks.size() == 1) return std::move(chunks.front());
    Chunk whole;
    whole.vertices.reserve(vertex_count);
    whole.faces.reserve(face_count);
    for (Chunk& chunk : chunks) whole.append(std::exchange(chunk, {}));
    return whole;
}

Mesh Merger::take_mesh() { return Mesh(join(take_chunks(), 1).arrays); }

Mesh Merger::take_sorted_mesh(std::uint32_t threads) {
    auto [arrays, active] = join(take_chunks(), threads);
    std::vector<VertexId> new_ids;
    Mesh mesh = Mesh::sorted(std::move(arrays), threads, &new_ids);
    active_.clear();
    for (VertexId v : active) active_.push_back(new_ids[index(v)]);
    return mesh;
}

void Merger::put_back(Mesh& mesh) { add(regionmesh::take_chunk(mesh, std::exchange(active_, {}))); }

std::uint64_t release_all(Mesh& mesh) {
    std::uint64_t pinned = 0;
    for (std::uint32_t v = 0; v < mesh.vertex_end(); ++v) {
        Vertex& vertex = mesh[VertexId{v}];
        pinned += vertex.is_alive && (vertex.sides & kPinned) != 0;
        vertex.is_fixed = false;
        vertex.sides &= static_cast<SideSet>(~kPinned);
    }
    return pinned;
}

}  // namespace regionmesh
