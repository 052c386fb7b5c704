// The first stage: the tiles of a chunk, before they join the mesh.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "mesh/safe_interval.h"
#include "regionmesh/lattice.h"
#include "simplify/tiles/simplify_tiles.h"
#include "surface/chunk.h"

namespace regionmesh {

/// How a volume is cut into tiles: from its size only, so that nothing else changes the result.
struct TilePlan {
    Lattice lattice;  // whose origin and spacing made the positions
    Sweep sweep;
    std::uint32_t chunk_strips;                        // strips of a chunk, and length of its tiles along the sweep
    std::uint32_t tile_cells;                          // width of a tile along the other two axes
    bool is_bounded = true;                            // false: vertices may move beyond the lattice
    std::array<std::uint32_t, 3> first_cell{0, 0, 0};  // of a block; the origin is that of the whole volume
};
TilePlan plan_tiles(const Lattice& lattice, Sweep sweep);

/// The tiles of a plan with `cells` cells along each axis, the first ones `shift` cells shorter, all within the safe
/// interval along the sweep. 0 cells: one tile along that axis.
TileGrid grid_of(const TilePlan& plan, std::array<std::uint32_t, 3> cells, std::array<std::uint32_t, 3> shift = {},
                 SafeInterval safe = {});

/// Tiles of the first stage, up to its threshold, where the target leaves this share of the faces.
TileOptions first_stage(const SimplifyOptions& simplify, double share, std::uint32_t threads);

/// Simplifies a chunk tile by tile, up to the threshold of the options. Locked vertices and faces
/// outside the safe interval stay as they are (TiledFaces); a tile's merged vertices stay strictly inside it, so
/// that the changes of two tiles cannot meet. `carried` are the chunk's carried vertices. The order of tiles, vertices
/// and faces depends on the chunk only.
TileResult simplify_chunk(const Chunk& chunk, std::span<const ChunkVertex> carried, SafeInterval safe,
                          const TilePlan& plan, const TileOptions& options);

}  // namespace regionmesh
