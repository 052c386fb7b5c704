// The first stage of decimation: boxes of cells, each worked on alone and in cache, before they reach the model.
#pragma once

#include <cstdint>
#include <span>

#include "mesh/chunk.h"
#include "regionmesh/lattice.h"
#include "simplify/simplify_boxes.h"

namespace regionmesh {

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

/// Decimates the batch of a whole run in place, tile by tile. Vertices that two tiles share, or that are carried or
/// open, are fixed, and so are those of faces that reach out of their tile's box; a tile's merged vertices stay
/// strictly inside its box, so that what two tiles change cannot meet. `carried` are the batch's carried vertices. The
/// order of tiles, vertices and faces depends on the batch.
VerdictCounts decimate_tiles(Chunk& batch, std::span<const ChunkVertex> carried, RunExtent extent, const TilePlan& plan,
                             const TileOptions& options);

}  // namespace regionmesh
