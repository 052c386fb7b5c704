// What the stages note while a run goes on: times, bytes, verdicts and progress.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <thread>

#include "regionmesh/process.h"
#include "regionmesh/reconstruct.h"
#include "stream/progress_shares.h"

namespace regionmesh {

using OnProgress = std::function<void(const Progress&)>;

/// Fills the report of a result. No result depends on it.
class RunLog {
public:
    RunLog(Reconstruction& result, const OnProgress& on_progress) : result_(result), on_progress_(on_progress) {}

    Report& report() { return result_.report; }

    /// Adds the time until its end to the seconds of a stage.
    [[nodiscard]] Timer time(const char* stage) { return Timer(result_.report.seconds[stage]); }

    void add(const VerdictCounts& verdicts) {
        for (int n = 0; n < kVerdictCount; ++n) result_.report.verdicts[n] += verdicts[n];
    }

    /// Notes the bytes of the mesh, and of what works on it, with `faces` faces.
    void note_bytes(std::uint64_t faces, std::size_t bytes) {
        if (faces == 0 || bytes < most_bytes_) return;
        most_bytes_ = bytes;
        result_.report.peak_faces = std::max(result_.report.peak_faces, faces);
        result_.report.bytes_per_face = static_cast<double>(bytes) / static_cast<double>(faces);
    }

    /// Notes that the whole run will need so many bytes, and says so.
    void note_bytes_needed(std::uint64_t bytes, const char* stage) {
        if (bytes <= progress_.bytes_needed) return;
        progress_.bytes_needed = bytes;
        report_progress(stage);
    }

    void note_strip_count(std::uint32_t strips) { progress_.strip_count = strips; }

    /// Notes a strip that was meshed, before smoothing.
    void note_strip(std::uint32_t strips_read, std::uint64_t faces, std::uint64_t vertices) {
        result_.report.initial_faces += faces;
        result_.report.initial_vertices += vertices;
        progress_.strips_read = strips_read;
        progress_.faces_read = result_.report.initial_faces;
        advance(WorkStage::kMesh, share_of_strips(strips_read));
        report_progress("reconstruct");
    }

    /// Notes strips that went through a stage, and says so.
    void note_strips_through(WorkStage stage, double strips) {
        advance(stage, share_of_strips(strips));
        report_progress("reconstruct");
    }

    void leave_out(WorkStage stage) { shares_.leave_out(stage); }
    void advance(WorkStage stage, double share) { shares_.advance(stage, share); }

    /// Only the thread that made the log reports; from others the call does nothing.
    void report_progress(const char* stage) {
        if (!on_progress_ || std::this_thread::get_id() != thread_) return;
        progress_.stage = stage;
        progress_.share = shares_.share();
        // While tiles are at work the mesh is taken apart, and has none.
        if (result_.mesh.face_count() > 0) progress_.faces_held = result_.mesh.face_count();
        on_progress_(progress_);
    }

private:
    double share_of_strips(double strips) const { return strips / std::max(progress_.strip_count, 1u); }

    Reconstruction& result_;
    const OnProgress& on_progress_;
    Progress progress_;
    ProgressShares shares_;
    std::thread::id thread_ = std::this_thread::get_id();
    std::size_t most_bytes_ = 0;
};

}  // namespace regionmesh
