// What the stages note while a run goes on: times, bytes, verdicts and progress.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <mutex>
#include <new>
#include <string>
#include <thread>

#include "regionmesh/process.h"
#include "regionmesh/reconstruct.h"
#include "stream/progress_shares.h"

namespace regionmesh {

class RunLog;

/// Adds its lifetime to the seconds of a stage, and notes the memory in its end.
class StageTimer {
public:
    StageTimer(RunLog& log, const char* stage);
    ~StageTimer();
    StageTimer(const StageTimer&) = delete;
    StageTimer& operator=(const StageTimer&) = delete;

private:
    RunLog& log_;
    const char* stage_;
    Timer timer_;
};

/// Fills the report of a result. No result depends on it. Times, strips and progress may be noted by several threads.
class RunLog {
public:
    RunLog(Reconstruction& result, const OnProgress& on_progress) : result_(result), on_progress_(on_progress) {}

    Report& report() { return result_.report; }

    /// Of two threads that time stages, each must have stages of its own.
    [[nodiscard]] StageTimer time(const char* stage) { return {*this, stage}; }
    /// The seconds of a stage, to add to.
    double& seconds_of(const char* stage) {
        const std::scoped_lock lock(mutex_);
        return result_.report.seconds[stage];
    }

    /// Notes the resident size for a stage. Looks at it every few milliseconds at most, and always at the first time.
    void note_resident(const std::string& stage) {
        constexpr std::chrono::milliseconds kPause{10};
        const std::scoped_lock lock(mutex_);
        std::uint64_t& most = result_.report.stage_bytes[stage];
        const auto now = std::chrono::steady_clock::now();
        if (most != 0 && now < next_look_) return;
        next_look_ = now + kPause;
        const ResidentBytes bytes = resident_bytes();
        // Where the peak rose since the last look, it was in this stage.
        most = std::max(most, bytes.peak > peak_ ? bytes.peak : bytes.now);
        peak_ = bytes.peak;
    }

    void add(const VerdictCounts& verdicts) {
        for (int n = 0; n < kVerdictCount; ++n) result_.report.verdicts[n] += verdicts[n];
    }

    /// Notes the bytes of the mesh, and of what works on it, with `faces` faces.
    void note_bytes(std::uint64_t faces, std::size_t bytes) {
        result_.report.peak_faces = std::max(result_.report.peak_faces, faces);
        if (faces == 0 || bytes < most_bytes_) return;
        most_bytes_ = bytes;
        result_.report.bytes_per_face = static_cast<double>(bytes) / static_cast<double>(faces);
    }

    /// Notes that the whole run will need so many bytes, and says so.
    void note_bytes_needed(std::uint64_t bytes, const char* stage) {
        if (bytes <= progress_.bytes_needed) return;
        progress_.bytes_needed = bytes;
        report_progress(stage);
    }

    /// Of the model while it is in chunks.
    void note_faces_held(std::uint64_t faces) {
        const std::scoped_lock lock(mutex_);
        progress_.faces_held = faces;
    }

    void note_strip_count(std::uint32_t strips) { progress_.strip_count = strips; }

    void note_strips_counted(std::uint32_t strips) {
        advance(WorkStage::kCount, share_of_strips(strips));
        report_progress("count");
    }

    /// Notes a strip that was meshed, before smoothing.
    void note_strip(std::uint32_t strips_read, std::uint64_t faces, std::uint64_t vertices) {
        {
            const std::scoped_lock lock(mutex_);
            result_.report.initial_faces += faces;
            result_.report.initial_vertices += vertices;
            progress_.strips_read = strips_read;
            progress_.faces_read = result_.report.initial_faces;
        }
        advance(WorkStage::kMesh, share_of_strips(strips_read));
        report_progress("reconstruct");
    }

    /// Notes strips that went through a stage, and says so.
    void note_strips_through(WorkStage stage, double strips) {
        advance(stage, share_of_strips(strips));
        report_progress("reconstruct");
    }

    void leave_out(WorkStage stage) { shares_.leave_out(stage); }
    void advance(WorkStage stage, double share) {
        const std::scoped_lock lock(mutex_);
        shares_.advance(stage, share);
    }

    /// Only the thread that made the log reports; from others the call does nothing.
    void report_progress(const char* stage) {
        if (!on_progress_ || std::this_thread::get_id() != thread_) return;
        Progress progress;
        {
            const std::scoped_lock lock(mutex_);
            progress_.stage = stage;
            progress_.share = shares_.share();
            // There is no mesh while the model is in chunks.
            if (result_.mesh.face_count() > 0) progress_.faces_held = result_.mesh.face_count();
            progress = progress_;
        }
        on_progress_(progress);
    }

private:
    double share_of_strips(double strips) const { return strips / std::max(progress_.strip_count, 1u); }

    std::mutex mutex_;
    Reconstruction& result_;
    const OnProgress& on_progress_;
    Progress progress_;
    ProgressShares shares_;
    std::thread::id thread_ = std::this_thread::get_id();
    std::size_t most_bytes_ = 0;
    std::uint64_t peak_ = result_.report.peak_bytes;  // resident, at the last look
    std::chrono::steady_clock::time_point next_look_;
};

inline StageTimer::StageTimer(RunLog& log, const char* stage)
    : log_(log), stage_(stage), timer_(log.seconds_of(stage)) {}
inline StageTimer::~StageTimer() {
    try {
        log_.note_resident(stage_);
    } catch (const std::bad_alloc&) {  // no memory to note it: the report lacks it
    }
}

}  // namespace regionmesh
