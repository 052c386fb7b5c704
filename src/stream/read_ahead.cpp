#include "stream/read_ahead.h"

#include <algorithm>
#include <cassert>

#include "base/task_arenas.h"

namespace regionmesh {

bool ReadAhead::next(std::span<InputLabel> section) {
    assert(section.size() == std::size_t{section_width()} * section_height());
    if (!thread_.joinable()) start();
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return !is_wanted_; });
    if (failure_) std::rethrow_exception(failure_);
    if (is_end_) return false;
    std::copy(section_.begin(), section_.end(), section.begin());
    is_wanted_ = true;
    changed_.notify_one();
    return true;
}

void ReadAhead::rewind() {
    stop();
    reader_.rewind();
}

void ReadAhead::start() {
    section_.resize(std::size_t{section_width()} * section_height());
    is_wanted_ = true;
    is_stopping_ = is_end_ = false;
    failure_ = nullptr;
    thread_ = std::thread([this] { read_all(); });
}

void ReadAhead::stop() {
    if (!thread_.joinable()) return;
    {
        const std::lock_guard lock(mutex_);
        is_stopping_ = true;
    }
    changed_.notify_one();
    thread_.join();
}

void ReadAhead::read_all() {
    const ArenasApart apart;  // callers that wait in next() may hold all places in the other arenas
    bool is_end = false;
    while (!is_end) {
        std::exception_ptr failure;
        try {
            is_end = !reader_.next(section_);
        } catch (...) {
            failure = std::current_exception();
            is_end = true;
        }
        std::unique_lock lock(mutex_);
        is_end_ = is_end;
        failure_ = failure;
        is_wanted_ = false;
        changed_.notify_one();
        changed_.wait(lock, [&] { return is_wanted_ || is_stopping_; });
        if (is_stopping_) return;
    }
}

}  // namespace regionmesh
