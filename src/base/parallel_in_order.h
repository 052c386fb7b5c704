// Work on several cores whose results are taken in order.
#pragma once

#include <cstdint>
#include <functional>

namespace regionmesh {

/// Work on items 0 .. count - 1. At most `in_flight` items are begun and not yet finished; `place`, below `in_flight`,
/// is theirs alone meanwhile, for what work leaves to finish.
struct OrderedWork {
    std::function<void(std::uint32_t n, std::uint32_t place)> work;    // in any order, several at a time
    std::function<void(std::uint32_t n, std::uint32_t place)> finish;  // after work, one at a time, in order of n
};

/// Does it on at most `threads` threads (0: one per core). Calls of work may not touch the same data, nor what finish
/// writes. A slow item keeps nobody waiting until `in_flight` are begun. What a call throws is thrown here.
void parallel_in_order(std::uint32_t count, std::uint32_t in_flight, std::uint32_t threads, const OrderedWork& calls);

}  // namespace regionmesh
