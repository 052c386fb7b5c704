// The request to stop that holds on this thread, to be handed to the threads that work for it.
#pragma once

#include <atomic>

#include "regionmesh/stop.h"

namespace regionmesh {

/// Null where there is none.
const std::atomic<bool>* stop_of_this_thread();

inline void throw_if(const std::atomic<bool>* stop) {
    if (stop != nullptr && stop->load(std::memory_order_relaxed)) throw Stopped{};
}

}  // namespace regionmesh
