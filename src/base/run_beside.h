// Two pieces of work at the same time.
#pragma once

#include <cstdint>
#include <functional>

namespace regionmesh {

/// Calls here() on this thread, and beside() on another of at most `threads` (0: one per core) if one is free before
/// here() ends, and on this one afterwards otherwise. A thread whose own work is done helps with loops of the other
/// (parallel_for, parallel_in_order). Requires that they share no mutable data. Rethrows the exception of a call, or
/// Stopped (regionmesh/stop.h), after both have ended.
void run_beside(std::uint32_t threads, const std::function<void()>& beside, const std::function<void()>& here);

}  // namespace regionmesh
