// Long work on a thread of its own, while the calling thread serves Python: signals and progress.
#pragma once

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "regionmesh/reconstruct.h"
#include "regionmesh/section_reader.h"
#include "regionmesh/stop.h"

namespace regionmesh::python {

namespace py = pybind11;

/// Runs work that may last. Python's signal handlers and the progress callable run on the calling thread, so that
/// Ctrl-C raises there; the work then ends within parts of a second.
class Watch {
public:
    /// `on_progress`: None, or called as on_progress(stage, done, total) with total None where it is not known.
    explicit Watch(py::object on_progress) : on_progress_(std::move(on_progress)) {}

    /// Requires the GIL; releases it while the work runs. Throws what the work, a signal handler or the callable
    /// throws. May be called again where it did not throw.
    void run(const std::function<void()>& work);

    /// Ends the runs of all threads: when the interpreter ends, it ends threads that wait for the GIL. Waits two
    /// seconds at most. Requires the GIL.
    static void end_all();
    /// In a forked process, which has none of the threads.
    static void forget_all();

    // For the work, on any thread.
    void note(const char* stage, std::uint64_t done, std::optional<std::uint64_t> total);
    void stop_if_cancelled() const {
        if (is_cancelled_.load(std::memory_order_relaxed)) throw Stopped{};
    }

private:
    struct Note {
        std::string stage;
        std::uint64_t done = 0;
        std::optional<std::uint64_t> total;
    };

    class Listed;  // while it runs

    void serve(std::exception_ptr& failure);

    py::object on_progress_;
    std::atomic<bool> is_cancelled_ = false;
    std::mutex mutex_;
    std::condition_variable changed_;
    std::vector<Note> notes_;  // not handed out yet
    std::string stage_;        // of the last note
    std::chrono::steady_clock::time_point noted_{};
    bool is_done_ = false;
};

/// Translates the progress of a reconstruction into stages of known length.
class StageProgress {
public:
    StageProgress(Watch& watch, const ReconstructOptions& options) : watch_(watch), options_(options) {}
    void operator()(const Progress& progress);

private:
    Watch& watch_;
    const ReconstructOptions& options_;
    std::uint64_t faces_before_ = 0;  // decimation began with
};

/// The sections of another reader; stops where the run is cancelled.
class WatchedSections : public SectionReader {
public:
    WatchedSections(SectionReader& reader, const Watch& watch) : reader_(reader), watch_(watch) {}
    const VolumeInfo& info() const override { return reader_.info(); }
    bool next(std::span<InputLabel> section) override {
        watch_.stop_if_cancelled();
        return reader_.next(section);
    }
    void rewind() override { reader_.rewind(); }

private:
    SectionReader& reader_;
    const Watch& watch_;
};

}  // namespace regionmesh::python
