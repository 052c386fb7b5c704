#include "base/parallel_for.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include "base/stop.h"
#include "base/task_arenas.h"
#include "base/task_order.h"

namespace regionmesh {

void parallel_for(std::uint32_t count, std::uint32_t threads, const std::function<void(std::uint32_t)>& work) {
    const std::atomic<bool>* stop = stop_of_this_thread();
    if (threads == 1 || count < 2) {
        for (std::uint32_t n = 0; n < count; ++n) {
            throw_if(stop);
            work(n);
        }
        return;
    }
    TaskOrder begun, ended;
    begun.happened();
    const ComesFirstAtEnd joined(ended);
    arena_of(threads).execute([&] {
        oneapi::tbb::parallel_for(std::uint32_t{0}, count, [&](std::uint32_t n) {
            begun.comes_first();
            const HappenedAtEnd end(ended);
            throw_if(stop);
            const StopScope scope(stop);
            work(n);
        });
    });
}

}  // namespace regionmesh
