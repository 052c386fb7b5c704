#include "stream/merger.h"

#include <utility>

#include "regionmesh/limits.h"

namespace regionmesh {

void Merger::add(Chunk chunk) {
    chunks_.push_back(std::move(chunk));
    const ChunkCounts counts = count(chunks_);
    require_mesh_size("mesh", counts.vertices, counts.faces);
}

std::uint32_t Merger::active_count() const {
    return chunks_.empty() ? 0 : static_cast<std::uint32_t>(chunks_.back().active.size());
}

std::size_t Merger::bytes() const {
    const ChunkCounts counts = count(chunks_);
    return counts.vertices * sizeof(ChunkVertex) + counts.faces * sizeof(ChunkFace);
}

Chunk Merger::take_chunk() {
    std::vector<Chunk> chunks = std::exchange(chunks_, {});
    if (chunks.size() == 1) return std::move(chunks.front());
    const ChunkCounts counts = count(chunks);
    Chunk whole;
    whole.vertices.reserve(counts.vertices);
    whole.faces.reserve(counts.faces);
    for (Chunk& chunk : chunks) whole.append(std::exchange(chunk, {}));
    return whole;
}

Mesh Merger::take_mesh() { return Mesh(join(std::exchange(chunks_, {}), 1).arrays); }

Mesh Merger::take_sorted_mesh(std::uint32_t threads) {
    auto [arrays, active] = join(std::exchange(chunks_, {}), threads);
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
