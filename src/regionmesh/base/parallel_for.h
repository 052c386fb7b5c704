// Independent work on several cores.
#pragma once

#include <cstdint>
#include <functional>

namespace regionmesh {

/// Calls work(n) for n = 0 .. count - 1 on at most `threads` threads (0: one per core), in any order. Calls may not
/// touch the same data. What a call throws is thrown here.
void parallel_for(std::uint32_t count, std::uint32_t threads, const std::function<void(std::uint32_t)>& work);

}  // namespace regionmesh
