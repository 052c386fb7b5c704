#include "base/parallel_invoke.h"

#include <oneapi/tbb/task_arena.h>
#include <oneapi/tbb/task_group.h>

#include <atomic>
#include <exception>

#include "base/stop.h"
#include "base/task_arenas.h"
#include "base/task_order.h"

namespace regionmesh {

void parallel_invoke(std::uint32_t threads, const std::function<void()>& other, const std::function<void()>& own) {
    namespace tbb = oneapi::tbb;
    const std::atomic<bool>* stop = stop_of_this_thread();
    throw_if(stop);
    if (threads == 1) {
        own();
        other();
        return;
    }
    TaskOrder begun, ended;
    begun.happened();
    const ComesFirstAtEnd joined(ended);
    arena_of(threads).execute([&] {
        tbb::task_group group;
        // Both may be on another thread: this one waits outside where the arena is full.
        const auto call = [&](const std::function<void()>& function) {
            begun.comes_first();
            const HappenedAtEnd end(ended);
            const StopScope scope(stop);
            function();
        };
        std::atomic<bool> has_failed = false;
        std::exception_ptr failure;
        group.run([&] {
            if (!has_failed) call(other);
        });
        // In the loops of own(), its thread does not start other().
        tbb::this_task_arena::isolate([&] {
            try {
                call(own);
            } catch (...) {  // past the group, its destructor could throw what other() throws
                failure = std::current_exception();
                has_failed = true;
            }
        });
        group.wait();
        if (failure) std::rethrow_exception(failure);
    });
}

}  // namespace regionmesh
