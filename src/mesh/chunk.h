// A piece of surface on its way from the mesher to the mesh: the one form that all stages of the stream share.
#pragma once

#include <array>
#include <cstdint>
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

/// Vertices have numbers local to the chunk. The first `carried` are the active vertices of the chunk before, in the
/// order of its list `active`; then come `vertices`. Chunks to come may add faces to the vertices in `active`. All
/// others are finalized (P 3.4).
struct Chunk {
    std::uint32_t carried = 0;
    std::vector<ChunkVertex> vertices;
    std::vector<ChunkFace> faces;
    std::vector<std::uint32_t> active;
    std::vector<float> carried_bounds = {};  // that the error bounds of carried vertices rise to; or empty

    /// Appends the chunk that follows: its carried vertices are the active ones of this chunk.
    void append(const Chunk& next);

    void clear() {
        carried = 0;
        clear_reused(vertices);
        clear_reused(faces);
        clear_reused(active);
        clear_reused(carried_bounds);
    }
};

}  // namespace regionmesh
