// A piece of surface on its way from the mesher to the mesh: the one form that all stages of the stream share.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/reused_vector.h"
#include "regionmesh/label.h"
#include "regionmesh/vec3.h"

namespace regionmesh {

struct ChunkVertex {
    Vec3 position;
    SideSet sides = 0;
    float error_bound = 0;  // Vertex::error_bound
};
static_assert(sizeof(ChunkVertex) == 32);

struct ChunkFace {
    std::array<std::uint32_t, 3> vertices;  // normal from the first label to the second
    std::array<Label, 2> labels;
};
static_assert(sizeof(ChunkFace) == 20);

/// The lattice simplex of a vertex: its base node, and its kind in the order of kKinds (cells/kuhn.h).
struct VertexSimplex {
    std::array<std::uint32_t, 3> base;
    std::uint8_t kind;
};
static_assert(sizeof(VertexSimplex) == 16);

/// Vertices have numbers local to the chunk. The first `carried` are the active vertices of the chunk before, in the
/// order of its list `active`; then come `vertices`. Chunks to come may add faces to the vertices in `active`. All
/// others are finalized (P 3.4).
struct Chunk {
    std::uint32_t carried = 0;
    std::vector<ChunkVertex> vertices;
    std::vector<ChunkFace> faces;
    std::vector<std::uint32_t> active;
    std::vector<VertexSimplex> simplices = {};  // simplices of `vertices`, for smoothing inside the lattice; or empty
    std::vector<float> carried_bounds = {};     // values that the error bounds of carried vertices rise to; or empty

    /// Appends the chunk that follows: its carried vertices are the active ones of this chunk.
    void append(const Chunk& next);

    /// The error bound of a vertex becomes at least this one.
    void raise_bound(std::uint32_t local, float bound);

    void clear() {
        carried = 0;
        clear_reused(vertices);
        clear_reused(faces);
        clear_reused(active);
        clear_reused(simplices);
        clear_reused(carried_bounds);
    }
};

/// A vertex of a chunk by its number; `carried` are the vertices that the chunk carries.
inline const ChunkVertex& vertex_of(const Chunk& chunk, std::span<const ChunkVertex> carried, std::uint32_t local) {
    return local < chunk.carried ? carried[local] : chunk.vertices[local - chunk.carried];
}

/// The vertices that the next chunk carries.
std::vector<ChunkVertex> active_vertices(const Chunk& chunk, std::span<const ChunkVertex> carried);

/// Calls visit(local) for the vertices that stay as they are while the chunk is simplified: carried, active, pinned.
template <class Visit>
void for_fixed(const Chunk& chunk, Visit&& visit) {
    for (std::uint32_t local = 0; local < chunk.carried; ++local) visit(local);
    for (const std::uint32_t local : chunk.active) visit(local);
    for (std::uint32_t n = 0; n < chunk.vertices.size(); ++n)
        if (chunk.vertices[n].sides & kPinned) visit(chunk.carried + n);
}

}  // namespace regionmesh
