// Declares to the thread sanitizer the order that oneTBB guarantees. Does nothing in other builds.
#pragma once

#ifdef REGIONMESH_DECLARE_TASK_ORDER
#include <sanitizer/tsan_interface.h>
#endif

namespace regionmesh {

/// Everything before happened() on one thread comes before everything after a later comes_first() on another. To be
/// used only where oneTBB or C++ guarantees that: a wrong declaration hides a race.
class TaskOrder {
public:
#ifdef REGIONMESH_DECLARE_TASK_ORDER
    void happened() { __tsan_release(&place_); }
    void comes_first() { __tsan_acquire(&place_); }

private:
    char place_ = 0;
#else
    void happened() {}
    void comes_first() {}
#endif
};

/// Declares happened() where its scope ends, by an exception, too.
class HappenedAtEnd {
public:
    explicit HappenedAtEnd(TaskOrder& order) : order_(order) {}
    HappenedAtEnd(const HappenedAtEnd&) = delete;
    HappenedAtEnd& operator=(const HappenedAtEnd&) = delete;
    ~HappenedAtEnd() { order_.happened(); }

private:
    TaskOrder& order_;
};

/// The same for comes_first().
class ComesFirstAtEnd {
public:
    explicit ComesFirstAtEnd(TaskOrder& order) : order_(order) {}
    ComesFirstAtEnd(const ComesFirstAtEnd&) = delete;
    ComesFirstAtEnd& operator=(const ComesFirstAtEnd&) = delete;
    ~ComesFirstAtEnd() { order_.comes_first(); }

private:
    TaskOrder& order_;
};

}  // namespace regionmesh
