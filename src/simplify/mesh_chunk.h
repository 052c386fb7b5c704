// A mesh as one chunk, for the tiles, and back.
#pragma once

#include "mesh/chunk.h"
#include "regionmesh/mesh.h"

namespace regionmesh {

/// The whole mesh as a chunk whose active vertices are the fixed ones. Empties the mesh.
Chunk take_chunk(Mesh& mesh);

/// The mesh of a chunk that carries nothing; its active vertices are fixed.
Mesh mesh_of(const Chunk& chunk);

}  // namespace regionmesh
