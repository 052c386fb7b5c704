#include "base/task_arenas.h"

#include <oneapi/tbb/info.h>

#include <algorithm>
#include <map>
#include <mutex>
#include <utility>

#include "base/task_order.h"

namespace regionmesh {
namespace {

thread_local bool is_apart = false;
TaskOrder all_are_made;  // C++ guarantees it, but the thread sanitizer does not see it in this file

}  // namespace

ArenasApart::ArenasApart() : before_(std::exchange(is_apart, true)) {}
ArenasApart::~ArenasApart() { is_apart = before_; }

oneapi::tbb::task_arena& arena_of(std::uint32_t threads) {
    struct Arenas {
        std::mutex mutex;
        std::map<std::pair<bool, std::uint32_t>, oneapi::tbb::task_arena> by_kind;
    };
    static Arenas* const all = [] {
        auto* const made = new Arenas;  // never destroyed: other threads may outlive main()
        all_are_made.happened();
        return made;
    }();
    all_are_made.comes_first();
    const auto cores = static_cast<std::uint32_t>(oneapi::tbb::info::default_concurrency());
    const std::uint32_t count = threads == 0 ? cores : std::min(threads, cores);
    const std::lock_guard lock(all->mutex);
    return all->by_kind.try_emplace({is_apart, count}, static_cast<int>(count)).first->second;
}

}  // namespace regionmesh
