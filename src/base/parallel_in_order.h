// Work on several threads whose results are used in order.
#pragma once

#include <cstdint>
#include <functional>

namespace regionmesh {

/// Work on items 0 .. count - 1. At most `in_flight` items are begun and not yet finished. Each of them owns a `slot`
/// below `in_flight`, where work() leaves its result for finish().
struct OrderedWork {
    std::function<void(std::uint32_t n, std::uint32_t slot)> work;    // runs in any order, several at a time
    std::function<void(std::uint32_t n, std::uint32_t slot)> finish;  // runs after work, one at a time, in order of n
};

/// Runs on at most `threads` threads (0: one per core). Requires that calls of work() share no mutable data, and do not
/// use data that finish() writes. Other items go on until `in_flight` are begun. Rethrows the exception of a call,
/// or Stopped (regionmesh/stop.h).
void parallel_in_order(std::uint32_t count, std::uint32_t in_flight, std::uint32_t threads, const OrderedWork& calls);

}  // namespace regionmesh
