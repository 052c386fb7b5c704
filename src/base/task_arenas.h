// The threads that work is given to.
#pragma once

#include <oneapi/tbb/task_arena.h>

#include <cstdint>

namespace regionmesh {

/// The arena with that number of threads; 0: one per core. More than cores are no faster, and oneTBB prints a warning
/// about them. One arena for each number, for the life of the process, and one apart (ArenasApart): an arena made and
/// left for each call keeps memory, tens of megabytes after some thousand calls, where a worker leaves late.
oneapi::tbb::task_arena& arena_of(std::uint32_t threads);

/// While it lives, loops that this thread begins run in arenas apart. For a thread whose results are waited for by work
/// in the shared arenas: there it could wait for a slot that this work holds, or begin more of this work itself, and
/// would never go on.
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
