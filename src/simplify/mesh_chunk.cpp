#include "simplify/mesh_chunk.h"

namespace regionmesh {

Chunk take_chunk(Mesh& mesh) {
    Chunk chunk;
    std::vector<std::uint32_t> numbers(mesh.vertex_end());
    chunk.vertices.reserve(mesh.vertex_count());
    for (std::uint32_t v = 0; v < mesh.vertex_end(); ++v) {
        const Vertex& vertex = mesh[VertexId{v}];
        if (!vertex.is_alive) continue;
        numbers[v] = static_cast<std::uint32_t>(chunk.vertices.size());
        chunk.vertices.push_back({vertex.position, vertex.sides, vertex.error_bound()});
        if (vertex.is_fixed) chunk.active.push_back(numbers[v]);
    }
    chunk.faces.reserve(mesh.face_count());
    for (std::uint32_t f = 0; f < mesh.face_end(); ++f) {
        if (!mesh.is_alive(FaceId{f})) continue;
        const auto& [a, b, c] = mesh[FaceId{f}].vertices;
        chunk.faces.push_back({{numbers[index(a)], numbers[index(b)], numbers[index(c)]}, mesh[FaceId{f}].labels});
    }
    mesh = {};
    return chunk;
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
