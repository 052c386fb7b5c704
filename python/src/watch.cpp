#include "watch.h"

#include <cmath>
#include <exception>
#include <string_view>
#include <thread>
#include <utility>

namespace regionmesh::python {
namespace {

constexpr std::chrono::milliseconds kBetweenNotes{50};
constexpr std::chrono::seconds kPatience{2};  // with an iterator or a callable that does not return

/// The runs under way. Changed with the GIL held.
std::vector<Watch*>& watches() {
    static std::vector<Watch*> all;
    return all;
}

}  // namespace

class Watch::Listed {
public:
    explicit Listed(Watch& watch) : watch_(watch) { watches().push_back(&watch); }
    ~Listed() { std::erase(watches(), &watch_); }
    Listed(const Listed&) = delete;
    Listed& operator=(const Listed&) = delete;

private:
    Watch& watch_;
};

void Watch::end_all() {
    const auto last = std::chrono::steady_clock::now() + kPatience;
    while (!watches().empty() && std::chrono::steady_clock::now() < last) {
        if (PyErr_CheckSignals() != 0) throw py::error_already_set();
        for (Watch* const watch : watches()) watch->is_cancelled_ = true;
        const py::gil_scoped_release release;
        std::this_thread::sleep_for(kBetweenNotes);
    }
}

void Watch::forget_all() { watches().clear(); }

void Watch::run(const std::function<void()>& work) {
    const Listed listed(*this);
    std::exception_ptr failure, own;
    is_done_ = false;
    std::thread worker([&] {
        const StopScope scope(is_cancelled_);
        try {
            work();
        } catch (...) {
            failure = std::current_exception();
        }
        const std::lock_guard lock(mutex_);
        is_done_ = true;
        changed_.notify_one();
    });
    serve(own);
    {
        const py::gil_scoped_release release;
        worker.join();
    }
    if (own) std::rethrow_exception(own);
    if (failure) std::rethrow_exception(failure);
}

void Watch::serve(std::exception_ptr& failure) {
    for (bool is_done = false; !is_done;) {
        std::vector<Note> notes;
        {
            const py::gil_scoped_release release;
            std::unique_lock lock(mutex_);
            changed_.wait_for(lock, kBetweenNotes, [&] { return is_done_ || !notes_.empty(); });
            notes.swap(notes_);
            is_done = is_done_;
        }
        if (failure) continue;
        try {
            if (PyErr_CheckSignals() != 0) throw py::error_already_set();
            if (on_progress_.is_none()) continue;
            for (const Note& note : notes) on_progress_(note.stage, note.done, note.total);
        } catch (py::error_already_set&) {
            failure = std::current_exception();
            is_cancelled_ = true;
        }
    }
}

void Watch::note(const char* stage, std::uint64_t done, std::optional<std::uint64_t> total) {
    stop_if_cancelled();
    const std::lock_guard lock(mutex_);
    const auto now = std::chrono::steady_clock::now();
    const bool is_end = total && done == *total;
    if (stage == stage_ && now - noted_ < kBetweenNotes && !is_end) return;
    stage_ = stage;
    noted_ = now;
    notes_.push_back({stage, done, total});
    changed_.notify_one();
}

void StageProgress::operator()(const Progress& progress) {
    const std::string_view stage = progress.stage;
    if (stage == "check") return watch_.note(progress.stage, 0, std::nullopt);
    if (stage != "decimate") return watch_.note(progress.stage, progress.strips_read, progress.strip_count);
    if (faces_before_ == 0) faces_before_ = progress.faces_held;
    std::optional<std::uint64_t> target = options_.target_faces;
    if (options_.reduce)
        target =
            static_cast<std::uint64_t>(std::llround(static_cast<double>(progress.faces_read) * (1 - *options_.reduce)));
    const std::uint64_t gone = faces_before_ - std::min(faces_before_, progress.faces_held);
    std::optional<std::uint64_t> total;
    if (target) total = std::max(gone, faces_before_ - std::min(faces_before_, *target));
    watch_.note(progress.stage, gone, total);
}

}  // namespace regionmesh::python
