// What reconstruction hands on: some more labelled faces, and which of their vertices are still open.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "regionmesh/base/label.h"
#include "regionmesh/base/vec3.h"

namespace regionmesh {

struct BatchVertex {
    Vec3 position;
    SideSet sides = 0;
};

struct BatchFace {
    std::array<std::uint32_t, 3> vertices;  // normal from the first label to the second
    std::array<Label, 2> labels;
};

/// Vertices have numbers local to the batch: the first `carried` are those the batch before listed as `open`, in that
/// order; then come `vertices`. All that are not in `open` have all their faces now: they are finalized (P 3.4).
struct FaceBatch {
    std::uint32_t carried = 0;
    std::vector<BatchVertex> vertices;
    std::vector<BatchFace> faces;
    std::vector<std::uint32_t> open;

    /// Appends the batch that follows: its carried vertices are this one's open ones.
    void append(const FaceBatch& next);

    void clear() {
        carried = 0;
        vertices.clear();
        faces.clear();
        open.clear();
    }
};

}  // namespace regionmesh
