#include "simplify/mesh_chunk.h"

namespace regionmesh {

Chunk take_chunk(Mesh& mesh, std::span<const VertexId> active) {
    Chunk chunk;
    chunk.vertices.reserve(mesh.vertex_count());
    chunk.faces.reserve(mesh.face_count());
    // Vertices are released before faces are copied.
    auto [vertices, faces] = mesh.release();
    std::vector<std::uint32_t> numbers(vertices.size());
    for (std::uint32_t v = 0; v < vertices.size(); ++v) {
        const Vertex& vertex = vertices[v];
        if (!vertex.is_alive) continue;
        numbers[v] = static_cast<std::uint32_t>(chunk.vertices.size());
        chunk.vertices.push_back({vertex.position, vertex.sides, vertex.error_bound()});
    }
    vertices = {};
    for (const auto& [corners, next, labels] : faces) {
        const auto [a, b, c] = corners;
        if (a == kNoVertex) continue;
        chunk.faces.push_back({{numbers[index(a)], numbers[index(b)], numbers[index(c)]}, labels});
    }
    for (VertexId v : active) chunk.active.push_back(numbers[index(v)]);
    return chunk;
}

Chunk take_chunk(Mesh& mesh) {
    std::vector<VertexId> fixed;
    for (std::uint32_t v = 0; v < mesh.vertex_end(); ++v)
        if (mesh.is_alive(VertexId{v}) && mesh[VertexId{v}].is_fixed) fixed.push_back(VertexId{v});
    return take_chunk(mesh, fixed);
}

Mesh mesh_of(const Chunk& chunk) {
    Mesh mesh;
    mesh.reserve(chunk.vertices.size(), chunk.faces.size());
    for (const ChunkVertex& vertex : chunk.vertices)
        mesh[mesh.add_vertex(vertex.position, vertex.sides)].set_error_bound(vertex.error_bound);
    for (const auto& [corners, labels] : chunk.faces)
        mesh.add_face(VertexId{corners[0]}, VertexId{corners[1]}, VertexId{corners[2]}, labels[0], labels[1]);
    for (std::uint32_t v : chunk.active) mesh[VertexId{v}].is_fixed = true;
    return mesh;
}

}  // namespace regionmesh
