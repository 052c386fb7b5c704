// Gathers strips into the chunks that tiles are cut from.
#pragma once

#include <cmath>
#include <vector>

#include "mesh/safe_interval.h"
#include "stream/run_log.h"
#include "stream/strips.h"
#include "surface/chunk.h"

namespace regionmesh {

/// Consecutive strips as one chunk, and where it lies.
struct GatheredStrips {
    Chunk chunk;
    /// The vertices that the chunk carries, in its order. They are fixed until their last face is there.
    std::vector<ChunkVertex> carried;
    /// Where its faces may change: no faces of other chunks reach into it.
    SafeInterval safe;
    /// Surface that is to come lies here or beyond along the sweep.
    double safe_high = 0;
    /// Strips gathered so far.
    std::uint32_t end = 0;
    bool is_last = false;
};

/// A chunk of `chunk_strips` strips at a time; the last one may be shorter.
class Gatherer {
public:
    Gatherer(Strips& strips, std::uint32_t chunk_strips, RunLog& log)
        : strips_(strips), chunk_strips_(chunk_strips), log_(log) {}

    /// The next chunk; false when there is none.
    bool next(GatheredStrips& made);

private:
    Strips& strips_;
    std::uint32_t chunk_strips_;
    RunLog& log_;
    Chunk strip_;
    std::vector<ChunkVertex> active_;                 // left by the last chunk
    double reach_ = -HUGE_VAL;                        // highest vertex of all chunks so far along the sweep
    std::size_t most_vertices_ = 0, most_faces_ = 0;  // of a chunk so far
};

}  // namespace regionmesh
