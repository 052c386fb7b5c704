// A mesh as one chunk, for the tiles, and back.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

#include "mesh/chunk.h"
#include "regionmesh/mesh.h"

namespace regionmesh {

/// The whole mesh as a chunk with these active vertices, or the fixed ones. Empties the mesh.
Chunk take_chunk(Mesh& mesh, std::span<const VertexId> active);
Chunk take_chunk(Mesh& mesh);

/// Bytes that a mesh and its chunk take at most while the one becomes the other: first there are all vertices twice,
/// then all faces.
constexpr std::size_t take_chunk_bytes(std::size_t vertices, std::size_t faces) {
    return vertices * (sizeof(ChunkVertex) + sizeof(std::uint32_t)) + faces * sizeof(Face) +
           std::max(vertices * sizeof(Vertex), faces * sizeof(ChunkFace));
}

/// The mesh of a chunk that carries nothing; its active vertices are fixed.
Mesh mesh_of(const Chunk& chunk);

}  // namespace regionmesh
