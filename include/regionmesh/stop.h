// Ends long work from another thread.
#pragma once

#include <atomic>

namespace regionmesh {

/// Thrown by work that was stopped. Not an Error: nothing is wrong with the input.
struct Stopped {};

/// While it lives, functions of the library that this thread calls look at `stop` before each part of their parallel
/// work, and throw Stopped once it is true. A part takes milliseconds, of a tile up to some tenths of a second. What
/// the stopped function was to change is left in an unknown state. Scopes nest; the inner one counts.
class StopScope {
public:
    explicit StopScope(const std::atomic<bool>& stop) : StopScope(&stop) {}
    explicit StopScope(const std::atomic<bool>* stop);  // null: nothing stops them
    ~StopScope();
    StopScope(const StopScope&) = delete;
    StopScope& operator=(const StopScope&) = delete;

private:
    const std::atomic<bool>* outer_;
};

}  // namespace regionmesh
