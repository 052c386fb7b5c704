#include "regionmesh/base/parallel_for.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

namespace regionmesh {

void parallel_for(std::uint32_t count, std::uint32_t threads, const std::function<void(std::uint32_t)>& work) {
    if (threads == 1 || count < 2) {
        for (std::uint32_t n = 0; n < count; ++n) work(n);
        return;
    }
    oneapi::tbb::task_arena arena(threads == 0 ? oneapi::tbb::task_arena::automatic : static_cast<int>(threads));
    arena.execute([&] { oneapi::tbb::parallel_for(std::uint32_t{0}, count, work); });
}

}  // namespace regionmesh
