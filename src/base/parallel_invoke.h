// Two functions at the same time.
#pragma once

#include <cstdint>
#include <functional>

namespace regionmesh {

/// Calls own() on this thread and other() at the same time on another thread, with at most `threads` threads in all (0:
/// one per core). If no thread is free, calls other() after own(). If all of these threads work for other callers, one
/// of them calls both and this one waits. A thread that has finished its function takes parts of the loops of the other
/// one (parallel_for, parallel_in_order). Requires that the functions share no mutable data. Rethrows an exception of
/// theirs, or Stopped (regionmesh/stop.h), after both have ended: that of other() if both throw. Where own() has thrown
/// before other() begins, other() is not called.
void parallel_invoke(std::uint32_t threads, const std::function<void()>& other, const std::function<void()>& own);

}  // namespace regionmesh
