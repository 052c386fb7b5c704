// Bytes that simplifying takes in addition to the mesh, derived from the structures.
#pragma once

#include "simplify/candidates.h"
#include "simplify/tiled_faces.h"
#include "simplify/vertex_quadrics.h"

namespace regionmesh {

/// Ranked collapses of a large mesh, per vertex, with quadrics; the tree of boxes over the faces is not included
/// (FaceTree::bytes).
inline constexpr std::size_t kCollapseBytesPerVertex =
    Candidates::bytes_per_vertex(EdgeOrder::kInSweeps) + VertexQuadrics::kBytesPerVertex;
static_assert(kCollapseBytesPerVertex == 52, "docs/memory.md has these numbers");

/// A chunk that is cut into tiles, a face with half a vertex: the chunk, the chunk made of it, and the tables of tiles.
inline constexpr std::size_t kTilingBytesPerFace =
    2 * (sizeof(ChunkFace) + sizeof(ChunkVertex) / 2) + TiledFaces::kBytesPerFace + TiledFaces::kBytesPerVertex / 2;

}  // namespace regionmesh
