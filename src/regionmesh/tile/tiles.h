// The first stage of decimation: boxes of cells, each worked on alone and in cache, before they reach the model.
#pragma once

#include <cstdint>
#include <span>

#include "regionmesh/decimate/decimate.h"
#include "regionmesh/tets/face_batch.h"
#include "regionmesh/tile/box_grid.h"
#include "regionmesh/volume/lattice.h"

namespace regionmesh {

/// Tiles out of their batch at a time, where memory is not short.
inline constexpr std::uint32_t kTilesInFlight = 16;

/// How a volume is cut: from its size only, so that nothing else changes the result.
struct TilePlan {
    Lattice lattice;  // whose origin and spacing made the positions
    Sweep sweep;
    std::uint32_t run_strips;  // strips of a run; the tiles of a run are so long along the sweep
    std::uint32_t tile_cells;  // and so wide along the other two axes
};
TilePlan plan_tiles(const Lattice& lattice, Sweep sweep);

/// Along the sweep faces of earlier runs reach up to `low` at most, those of later ones down to `high`.
struct RunExtent {
    double low, high;
};

struct TileOptions {
    double cost_level;                         // in units of scale^4: collapses up to this cost
    double keep_share;                         // no tile goes below this share of its faces
    std::uint32_t threads = 1;                 // tiles at work at a time; 0: one per core. The result is the same
    std::uint32_t in_flight = kTilesInFlight;  // tiles out of the batch at a time, likewise
    DecimateOptions decimate;  // quality, perturbation, scale, tests; target, cost and limits are the tile's own
};

struct TileResult {
    VerdictCounts verdicts{};
};

/// Decimates the batch of a whole run in place, tile by tile. Vertices that two tiles share, or that are carried or
/// open, are fixed, and so are those of faces that reach out of their tile's box; a tile's merged vertices stay
/// strictly inside its box, so that what two tiles change cannot meet. `carried` are the batch's carried vertices. The
/// order of tiles, vertices and faces depends on the batch.
TileResult decimate_tiles(FaceBatch& batch, std::span<const BatchVertex> carried, RunExtent extent,
                          const TilePlan& plan, const TileOptions& options);

/// The same for any boxes.
TileResult decimate_boxes(FaceBatch& batch, std::span<const BatchVertex> carried, const BoxGrid& grid,
                          const TileOptions& options);

}  // namespace regionmesh
