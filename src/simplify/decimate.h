// One decimation for all surfaces: a written model, what a stream has merged, a block.
#pragma once

#include <cstdint>
#include <functional>

#include "regionmesh/simplify.h"
#include "simplify/collapse_edges.h"
#include "simplify/tiles/threshold_passes.h"
#include "surface/chunk.h"

namespace regionmesh {

/// How a surface is cut and brought to its target. What is kept on the way are the promises in the options.
struct DecimatePlan {
    TilePlan tiles;
    double first_threshold = 0;  // of a first stage in kLowPasses passes, in units of scale^4; 0: the surface had one
    double margin = 1;           // passes end at this multiple of the target; the last collapses do the rest
    CollapseBounds last = {};    // of the collapses over the whole surface
};

struct DecimateResult {
    VerdictCounts verdicts{};
    std::uint32_t tile_passes = 0, refreshes = 0;
    StopReason stopped = StopReason::kTarget;
    std::size_t bytes = 0;  // held at most
};

/// Brings the surface to options.target_faces: passes in tiles, up to a threshold that leaves a little more; then, as
/// one mesh, cheapest edge first. Active vertices are fixed. Fewer tiles than kFewestTiles: no passes.
Mesh decimate(Chunk surface, const DecimatePlan& plan, const SimplifyOptions& options, DecimateResult& result);

/// The last part: the mesh is sorted.
void collapse_to_target(Mesh& mesh, const DecimatePlan& plan, const SimplifyOptions& options, DecimateResult& result);

/// Removes the faces that a stage after decimation added beyond the target, if decimation reached it. Returns the
/// largest bound on the error.
double trim_added(Mesh& mesh, const SimplifyOptions& options, StopReason stopped, VerdictCounts& verdicts);

}  // namespace regionmesh
