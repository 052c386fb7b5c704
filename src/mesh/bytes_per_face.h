// Memory of a surface by its number of faces. A closed surface has half as many vertices as faces.
#pragma once

#include <cstdint>

#include "mesh/chunk.h"
#include "regionmesh/mesh.h"

namespace regionmesh {

/// Bytes per face of a Mesh, each face with half a vertex.
constexpr std::uint64_t mesh_bytes_per_face() { return sizeof(Face) + sizeof(Vertex) / 2; }

/// Bytes per face of a Chunk, each face with half a vertex.
constexpr std::uint64_t chunk_bytes_per_face() { return sizeof(ChunkFace) + sizeof(ChunkVertex) / 2; }

}  // namespace regionmesh
