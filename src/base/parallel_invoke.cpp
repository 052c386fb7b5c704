#include "base/parallel_invoke.h"

#include <oneapi/tbb/task_arena.h>
#include <oneapi/tbb/task_group.h>

#include <optional>

#include "base/stop.h"
#include "base/task_arenas.h"
#include "base/task_order.h"

namespace regionmesh {

void parallel_invoke(std::uint32_t threads, const std::function<void()>& other, const std::function<void()>& own) {
    namespace tbb = oneapi::tbb;
    if (threads == 1) {
        own();
        other();
        return;
    }
    const std::atomic<bool>* stop = stop_of_this_thread();
    TaskOrder begun, ended;
    begun.happened();
    const ComesFirstAtEnd joined(ended);
    arena_of(threads).execute([&] {
        tbb::task_group group;
        group.run([&] {
            begun.comes_first();
            const HappenedAtEnd end(ended);
            std::optional<StopScope> scope;
            if (stop != nullptr) scope.emplace(*stop);
            other();
        });
        // In the loops of own(), this thread does not start other().
        tbb::this_task_arena::isolate(own);
        group.wait();
    });
}

}  // namespace regionmesh
