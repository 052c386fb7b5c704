// The second stage of decimation: the whole model, box by box, at a cost level that brings it near a number of faces.
#pragma once

#include <cstdint>

#include "mesh/chunk.h"
#include "simplify/tiles.h"

namespace regionmesh {

struct RaiseOptions {
    std::uint64_t goal_faces;            // of the batch, about; 0: as far as the options of decimation allow
    double high = HUGE_VAL;              // along the sweep: faces to come may reach down to it
    std::uint32_t box_faces = 8u << 10;  // about so many in a box
    TileOptions tiles;                   // level and share are found
};

struct RaiseResult {
    VerdictCounts verdicts{};
    std::uint32_t raises = 0;  // passes over the batch
    double level = 0;          // of the last, in units of scale^4
};

/// Decimates the batch of the whole model in passes. Each has boxes of its own: their walls lie elsewhere than those of
/// the pass before, and of the first stage. The level of a pass is found on one box in eight, which is decimated at two
/// or three levels and left as it was. Ends a little above the goal, so that a heap over all may trim; does nothing
/// when that is near already, or the model is small. Open vertices, and faces beyond `high`, stay as they are. Depends
/// on the batch and the sizes of the plan only.
RaiseResult raise_level(Chunk& batch, const TilePlan& plan, const RaiseOptions& options);

}  // namespace regionmesh
