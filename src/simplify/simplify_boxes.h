// Decimates a batch of faces box by box, on all threads.
#pragma once

#include <cstdint>
#include <span>

#include "mesh/chunk.h"
#include "regionmesh/simplify.h"
#include "simplify/boxed_faces.h"

namespace regionmesh {

/// Tiles out of their batch at a time, where memory is not short.
inline constexpr std::uint32_t kTilesInFlight = 16;

struct TileOptions {
    double cost_level;                         // in units of scale^4: collapses up to this cost
    double keep_share;                         // no tile goes below this share of its faces,
    double free_share = 1;                     // but by what costs nothing, down to this one where it is less
    std::uint32_t threads = 1;                 // tiles at work at a time; 0: one per core. The result is the same
    std::uint32_t in_flight = kTilesInFlight;  // tiles out of the batch at a time, likewise
    DecimateOptions decimate;  // quality, perturbation, scale, tests; target, cost and limits are the tile's own
};

struct TileResult {
    Chunk left;
    VerdictCounts verdicts{};
};

/// Decimates each box alone with its rim fixed; merged vertices stay strictly inside their box, so that what two boxes
/// change cannot meet. Vertices that were open are still, in their order.
TileResult decimate_boxes(BoxedFaces& faces, const TileOptions& options);

/// What some boxes hold, and what would be left of it.
struct BoxCounts {
    std::uint64_t faces = 0, left_faces = 0;    // their own
    std::uint64_t inside = 0, left_inside = 0;  // vertices that are not rim
};
BoxCounts try_boxes(BoxedFaces& faces, std::span<const std::uint32_t> boxes, const TileOptions& options);

}  // namespace regionmesh
