// A mesh as one chunk, for the tiles, and the mesh of chunks.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "regionmesh/mesh.h"
#include "surface/chunk.h"

namespace regionmesh {

/// Bytes of its vertices and faces.
inline std::size_t bytes_of(const Chunk& chunk) {
    return chunk.vertices.size() * sizeof(ChunkVertex) + chunk.faces.size() * sizeof(ChunkFace);
}

/// The whole mesh as a chunk with these active vertices, or the fixed ones. Empties the mesh.
Chunk take_chunk(Mesh& mesh, std::span<const VertexId> active);
Chunk take_chunk(Mesh& mesh);

/// A vertex of a mesh, in no star yet.
inline Vertex mesh_vertex(const ChunkVertex& vertex, bool is_fixed) {
    Vertex made{.position = vertex.position, .sides = vertex.sides, .is_fixed = is_fixed};
    made.set_error_bound(vertex.error_bound);
    return made;
}

/// Sums over all chunks.
struct ChunkCounts {
    std::uint64_t vertices = 0, faces = 0;
};
ChunkCounts count(std::span<const Chunk> chunks);

/// Vertices and faces of chunks, numbered in the order of the chunks, without stars; and the vertices that the last
/// chunk leaves active. These and pinned ones are fixed.
struct JoinedChunks {
    Mesh::Arrays arrays;
    std::vector<VertexId> active;
};
/// Requires that the first chunk carries nothing. Releases each chunk before it copies the next, so that at most one is
/// held twice. On at most `threads` threads (0: one per core). Throws Error(kInput) beyond the limits of limits.h.
JoinedChunks join(std::vector<Chunk> chunks, std::uint32_t threads);

/// The mesh of a chunk that carries nothing, sorted; its active vertices are fixed. `new_ids` becomes the ids of the
/// vertices of the chunk.
Mesh sorted_mesh_of(Chunk chunk, std::uint32_t threads = 1, std::vector<VertexId>* new_ids = nullptr);

}  // namespace regionmesh
