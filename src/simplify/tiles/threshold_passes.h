// The second stage: passes over the whole mesh, tile by tile, up to a threshold that leaves about the target.
#pragma once

#include <cstdint>

#include "simplify/tiles/tiles.h"
#include "surface/chunk.h"

namespace regionmesh {

struct PassOptions {
    std::uint64_t target_faces;             // of the chunk, about; 0: as far as the largest cost and error allow
    SafeInterval safe = {};                 // along the sweep: faces outside it stay as they are
    std::uint32_t tile_faces = kTileFaces;  // about this number in a tile
    TileOptions tiles;                      // threshold and share are searched for
};

struct PassResult {
    VerdictCounts verdicts{};
    std::uint32_t passes = 0;
};

/// The first stage of a mesh that did not come in runs of strips: kLowPasses passes up to the threshold of
/// `options.tiles`, whose shares are those of the chunk as it comes. Walls lie elsewhere in each.
PassResult simplify_below(Chunk& chunk, const TilePlan& plan, const PassOptions& options);

/// False where the target is near already, or the mesh is small: ranked collapses over the whole mesh are faster then.
bool is_worth_pass(std::uint64_t faces, const PassOptions& options);

/// Simplifies the chunk of a whole mesh in passes; the walls of the tiles lie elsewhere in each pass, and elsewhere
/// than those of the first stage. The threshold of a pass is searched for on a sample of its tiles. Ends a little above
/// the target, which ranked collapses over the whole mesh then reach. Makes no pass that is not worth it. Active
/// vertices stay as they are. Depends on the chunk and the sizes in the plan only.
PassResult simplify_in_passes(Chunk& chunk, const TilePlan& plan, const PassOptions& options);

}  // namespace regionmesh
