#include "base/parallel_for.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>

namespace regionmesh {

void parallel_for(std::uint32_t count, std::uint32_t threads, const std::function<void(std::uint32_t)>& work) {
    if (threads == 1 || count < 2) {
        for (std::uint32_t n = 0; n < count; ++n) work(n);
        return;
    }
    // More than there are cores would run no faster, and oneTBB would say so on stderr.
    const auto cores = static_cast<std::uint32_t>(oneapi::tbb::info::default_concurrency());
    oneapi::tbb::task_arena arena(static_cast<int>(threads == 0 ? cores : std::min(threads, cores)));
    arena.execute([&] { oneapi::tbb::parallel_for(std::uint32_t{0}, count, work); });
}

}  // namespace regionmesh
