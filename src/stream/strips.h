// The first stages: read -> cells -> smooth.
#pragma once

#include <memory>
#include <optional>

#include "smooth/chunk_smoother.h"
#include "stream/face_source.h"
#include "stream/run_log.h"
#include "surface/chunk.h"

namespace regionmesh {

/// How the strips of a source follow each other; smoothing holds `extra` strips more than it seems to need.
ChunkOrder strip_order(const SourceShape& shape, std::uint32_t extra);

/// Most strips that smoothing holds at a time; 0 for no passes.
std::uint32_t window_strips(const SmoothOptions& options, const ChunkOrder& order);

/// The strips of a source one after the other, each a chunk, smoothed where the options have passes.
class Strips {
public:
    Strips(FaceSource& source, const SmoothOptions& options, const ChunkOrder& order, RunLog& log);

    /// The next strip; false after the last one, and where smoothing is stuck.
    bool next(Chunk& strip);
    /// The strip at which smoothing turned out to hold too few strips: begin again and hold more.
    std::optional<std::uint32_t> stuck_strip() const;

    const FaceSource& source() const { return source_; }
    /// Strips handed out so far.
    std::uint32_t count() const { return count_; }
    bool is_at_end() const { return count_ == source_.shape().strip_count; }
    /// The high end of the safe interval: surface that was not handed out lies here or beyond along the sweep.
    double safe_high() const { return smoother_ ? smoother_->safe_high() : source_.low_of(count_); }
    bool is_smoothing() const { return smoother_ != nullptr; }
    /// Requires is_smoothing().
    const SmoothReport& smooth_report() const { return smoother_->report(); }

private:
    bool mesh_next(Chunk& strip);
    bool smooth_next(Chunk& strip);

    FaceSource& source_;
    RunLog& log_;
    std::uint32_t threads_;
    std::unique_ptr<ChunkSmoother> smoother_;
    std::uint32_t count_ = 0;
    Chunk ahead_;  // the strip after the one that the smoother was given last
    bool is_ahead_ = false;
};

}  // namespace regionmesh
