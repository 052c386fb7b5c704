#include "simplify/tiles/mesh_chunk.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "base/parallel_for.h"
#include "regionmesh/limits.h"

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

ChunkCounts count(std::span<const Chunk> chunks) {
    ChunkCounts sums;
    for (const Chunk& chunk : chunks) {
        sums.vertices += chunk.vertices.size();
        sums.faces += chunk.faces.size();
    }
    return sums;
}

namespace {

void append(JoinedChunks& joined, const Chunk& chunk, std::uint32_t threads) {
    constexpr std::uint32_t kItems = 1u << 14;  // of a task
    auto& [vertices, faces] = joined.arrays;
    const auto is_pinned = [](SideSet sides) { return (sides & kPinned) != 0; };
    const std::vector<VertexId> carried = std::exchange(joined.active, {});
    assert(chunk.carried == carried.size());
    for (std::size_t n = 0; n < chunk.carried_bounds.size(); ++n) {
        Vertex& vertex = vertices[index(carried[n])];
        vertex.set_error_bound(std::max(vertex.error_bound(), chunk.carried_bounds[n]));
    }
    for (VertexId v : carried) vertices[index(v)].is_fixed = is_pinned(vertices[index(v)].sides);

    const std::uint32_t first_vertex = vertices.size(), first_face = faces.size();
    const auto new_vertices = static_cast<std::uint32_t>(chunk.vertices.size()),
               new_faces = static_cast<std::uint32_t>(chunk.faces.size());
    const auto id_of = [&](std::uint32_t local) {
        return local < chunk.carried ? carried[local] : VertexId{first_vertex + local - chunk.carried};
    };
    vertices.resize_for_overwrite(first_vertex + new_vertices);
    for_each_index(new_vertices, kItems, threads, [&](std::uint32_t n) {
        vertices[first_vertex + n] = mesh_vertex(chunk.vertices[n], is_pinned(chunk.vertices[n].sides));
    });
    faces.resize_for_overwrite(first_face + new_faces);
    for_each_index(new_faces, kItems, threads, [&](std::uint32_t n) {
        const auto& [corners, labels] = chunk.faces[n];
        const auto [a, b, c] = corners;
        faces[first_face + n] = Face::between(id_of(a), id_of(b), id_of(c), labels[0], labels[1]);
    });
    for (std::uint32_t local : chunk.active) joined.active.push_back(id_of(local));
    for (VertexId v : joined.active) vertices[index(v)].is_fixed = true;
}

}  // namespace

JoinedChunks join(std::vector<Chunk> chunks, std::uint32_t threads) {
    const ChunkCounts counts = count(chunks);
    require_mesh_size("mesh", counts.vertices, counts.faces);
    JoinedChunks joined;
    joined.arrays.vertices.reserve(counts.vertices);
    joined.arrays.faces.reserve(counts.faces);
    for (Chunk& chunk : chunks) append(joined, std::exchange(chunk, {}), threads);
    return joined;
}

Mesh sorted_mesh_of(Chunk chunk, std::uint32_t threads, std::vector<VertexId>* new_ids) {
    std::vector<Chunk> chunks;
    chunks.push_back(std::move(chunk));
    return Mesh::sorted(join(std::move(chunks), threads).arrays, threads, new_ids);
}

}  // namespace regionmesh
