// Simplifies the faces of one block; its locked vertices, and the faces of other blocks, stay as they are.
#pragma once

#include <array>
#include <cstdint>

#include "blocks/block_grid.h"
#include "blocks/piece.h"
#include "judge/collapse_log.h"
#include "regionmesh/simplify.h"
#include "simplify/tuning.h"
#include "stream/target.h"
#include "surface/chunk.h"

namespace regionmesh {

/// A block and its faces. Active vertices of the chunk are locked: faces of other blocks use them, or they are corners
/// of faces that reach out of the block.
struct BlockChunk {
    IndexBox cells;
    Lattice lattice;  // of the whole volume
    Sweep sweep;
    Chunk chunk;
    std::uint64_t other_faces = 0;         // of the chunk: those of other blocks. All their vertices are locked
    std::vector<LoggedCollapse> log = {};  // collapses that may still be made (Piece::log), vertices of the chunk
};

struct BlockSimplifyOptions {
    SimplifyOptions simplify;  // without a target
    std::uint32_t threads = 0;
};

/// The first stage: tiles, up to the threshold of the first stage of a run without blocks, and never below the share
/// of the faces that the target leaves.
void simplify_low(BlockChunk& block, double share, const BlockSimplifyOptions& options);

/// The cost of the trial `n`, in units of scale^4.
double trial_threshold(int n);

/// Share of the faces that a sample of tiles keeps at each threshold; ends (with 0) below `least`. Leaves the faces as
/// they are.
std::array<double, kMostThresholdTrials> try_thresholds(const BlockChunk& block, double least,
                                                        const BlockSimplifyOptions& options);

/// Simplifies up to a threshold, in units of scale^4, but not below `least` faces of the block's own; a large block in
/// tiles, at whose walls cheaper edges may be left.
void simplify_up_to(BlockChunk& block, double threshold, std::uint64_t least, const BlockSimplifyOptions& options);

/// Simplifies the block as a whole up to a threshold, in its log alone. Returns kTarget where the threshold ended it.
StopReason simplify_and_log(BlockChunk& block, double threshold, const BlockSimplifyOptions& options);

/// Simplifies to `target` faces of the block's own, or as far as topology, quality and the largest error allow.
/// Returns what ended it.
StopReason simplify_to(BlockChunk& block, std::uint64_t target, const BlockSimplifyOptions& options);

}  // namespace regionmesh
