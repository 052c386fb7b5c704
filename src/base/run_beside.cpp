#include "base/run_beside.h"

#include <oneapi/tbb/task_arena.h>
#include <oneapi/tbb/task_group.h>

#include <optional>

#include "base/stop.h"
#include "base/task_arenas.h"
#include "base/task_order.h"

namespace regionmesh {

void run_beside(std::uint32_t threads, const std::function<void()>& beside, const std::function<void()>& here) {
    namespace tbb = oneapi::tbb;
    if (threads == 1) {
        here();
        beside();
        return;
    }
    const std::atomic<bool>* stop = stop_of_this_thread();
    TaskOrder begun, ended;
    begun.happened();
    arena_of(threads).execute([&] {
        tbb::task_group group;
        group.run([&] {
            begun.comes_first();
            std::optional<StopScope> scope;
            if (stop != nullptr) scope.emplace(*stop);
            beside();
            ended.happened();
        });
        // This thread begins nothing else while it waits for its own loops.
        tbb::this_task_arena::isolate(here);
        group.wait();
    });
    ended.comes_first();
}

}  // namespace regionmesh
