// What reconstruction hands on: some more labelled faces, and which of their vertices are still open.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "regionmesh/label.h"
#include "regionmesh/vec3.h"

namespace regionmesh {

struct ChunkVertex {
    Vec3 position;
    SideSet sides = 0;
};

struct ChunkFace {
    std::array<std::uint32_t, 3> vertices;  // normal from the first label to the second
    std::array<Label, 2> labels;
};

/// Vertices have numbers local to the batch: the first `carried` are those the batch before listed as `open`, in that
/// order; then come `vertices`. All that are not in `open` have all their faces now: they are finalized (P 3.4).
struct Chunk {
    std::uint32_t carried = 0;
    std::vector<ChunkVertex> vertices;
    std::vector<ChunkFace> faces;
    std::vector<std::uint32_t> open;

    /// Appends the batch that follows: its carried vertices are this one's open ones.
    void append(const Chunk& next);

    void clear() {
        carried = 0;
        vertices.clear();
        faces.clear();
        open.clear();
    }
};

}  // namespace regionmesh
