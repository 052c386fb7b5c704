// The threads that work is given to.
#pragma once

#include <oneapi/tbb/task_arena.h>

#include <cstdint>

namespace regionmesh {

/// The arena with that number of threads; 0: one per core. More than cores are no faster, and oneTBB prints a warning
/// about them. One arena for each number, for the life of the process: an arena made and left for each call keeps
/// memory, tens of megabytes after some thousand calls, where a worker leaves late.
oneapi::tbb::task_arena& arena_of(std::uint32_t threads);

/// While it lives, loops that this thread begins run in arenas apart from those of other threads. For a thread that
/// work of other threads waits for: in their arenas it could wait for a place that such work holds, or be given such
/// work itself, and then none of them would ever go on.
class ArenasApart {
public:
    ArenasApart();
    ArenasApart(const ArenasApart&) = delete;
    ArenasApart& operator=(const ArenasApart&) = delete;
    ~ArenasApart();

private:
    bool before_;
};

}  // namespace regionmesh
