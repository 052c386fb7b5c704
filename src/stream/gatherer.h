// Gathers strips into the chunks that tiles are cut from.
#pragma once

#include <cmath>
#include <span>
#include <vector>

#include "mesh/chunk.h"
#include "mesh/safe_interval.h"
#include "stream/run_log.h"
#include "stream/strips.h"

namespace regionmesh {

/// A chunk of `chunk_strips` strips at a time; the last one may be shorter.
class Gatherer {
public:
    Gatherer(Strips& strips, std::uint32_t chunk_strips, RunLog& log)
        : strips_(strips), chunk_strips_(chunk_strips), log_(log) {}

    /// The next chunk; false when there is none.
    bool next(Chunk& chunk);

    /// Chunks gathered so far.
    std::uint32_t count() const { return count_; }
    /// Strips gathered so far.
    std::uint32_t strip_count() const { return strips_.count(); }
    /// The vertices that the last chunk carries, in its order. They are fixed until their last face is there.
    std::span<const ChunkVertex> carried() const { return carried_; }
    /// Where the faces of the last chunk may change: no faces of other chunks reach into it.
    SafeInterval safe() const { return safe_; }

private:
    Strips& strips_;
    std::uint32_t chunk_strips_;
    RunLog& log_;
    Chunk strip_;
    std::uint32_t count_ = 0;
    std::vector<ChunkVertex> carried_, active_;  // active_: left by the last chunk
    double reach_ = -HUGE_VAL;                   // highest vertex of all chunks so far along the sweep
    SafeInterval safe_;
};

}  // namespace regionmesh
