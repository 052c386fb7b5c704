#include "base/parallel_in_order.h"

#include <oneapi/tbb/parallel_pipeline.h>

#include <algorithm>
#include <vector>

#include "base/stop.h"
#include "base/task_arenas.h"
#include "base/task_order.h"

namespace regionmesh {

void parallel_in_order(std::uint32_t count, std::uint32_t in_flight, std::uint32_t threads, const OrderedWork& calls) {
    namespace tbb = oneapi::tbb;
    in_flight = std::max(in_flight, 1u);
    const std::atomic<bool>* stop = stop_of_this_thread();
    if (threads == 1 || in_flight == 1 || count < 2) {
        for (std::uint32_t n = 0; n < count; ++n) {
            throw_if(stop);
            calls.work(n, 0);
            calls.finish(n, 0);
        }
        return;
    }
    // Items begin and finish in order, so those in flight are consecutive and n modulo in_flight is a slot of their
    // own.
    std::uint32_t next = 0;
    TaskOrder begun, finished, ended;
    std::vector<TaskOrder> slots(in_flight);  // order of each slot: the work of an item, its end, the next item
    begun.happened();
    const auto begin = tbb::make_filter<void, std::uint32_t>(tbb::filter_mode::serial_in_order,
                                                             [&](tbb::flow_control& control) -> std::uint32_t {
                                                                 if (next == count) {
                                                                     control.stop();
                                                                     return 0;
                                                                 }
                                                                 return next++;
                                                             });
    const auto work = tbb::make_filter<std::uint32_t, std::uint32_t>(tbb::filter_mode::parallel, [&](std::uint32_t n) {
        begun.comes_first();
        slots[n % in_flight].comes_first();
        const HappenedAtEnd end(ended), worked(slots[n % in_flight]);
        throw_if(stop);
        const StopScope scope(stop);
        calls.work(n, n % in_flight);
        return n;
    });
    const auto finish = tbb::make_filter<std::uint32_t, void>(tbb::filter_mode::serial_in_order, [&](std::uint32_t n) {
        slots[n % in_flight].comes_first();
        finished.comes_first();
        const HappenedAtEnd end(ended), last(finished), worked(slots[n % in_flight]);
        const StopScope scope(stop);
        calls.finish(n, n % in_flight);
    });
    const ComesFirstAtEnd joined(ended);
    arena_of(threads).execute([&] { tbb::parallel_pipeline(in_flight, begin & work & finish); });
}

}  // namespace regionmesh
