// Smoothing by filters in passes, with a guard, in a window that moves with the chunks (docs/explanation/smoothing.md,
// "The stream").
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "regionmesh/smooth.h"
#include "smooth/chunk_smoother.h"
#include "smooth/filters/backtrack.h"
#include "smooth/filters/filter.h"
#include "smooth/filters/intersection_resolver.h"
#include "smooth/filters/neighbours.h"

namespace regionmesh {

/// Pass k works one chunk behind pass k - 1, the rounds of backtracking follow like passes, then intersections are
/// resolved; and chunks are held until no later one can reach them. Whether the surface comes in chunks or as one,
/// filter and rounds give the same positions, bit for bit.
class Smoother final : public ChunkSmoother {
public:
    /// Requires options.passes > 0.
    Smoother(const SmoothOptions& options, const ChunkOrder& order);
    Smoother(const Smoother&) = delete;
    Smoother& operator=(const Smoother&) = delete;

    /// False where the window holds too few chunks to resolve all intersections.
    [[nodiscard]] bool add(const Chunk& chunk, bool is_last, double next_low) override;
    bool next(Chunk& chunk) override;
    /// Smooths a mesh in place, as the only chunk.
    void smooth_all(Mesh& mesh);

    std::uint32_t most_chunks() const override;
    std::optional<std::uint32_t> stuck_chunk() const override { return stuck_chunk_; }
    double safe_high() const override;
    const SmoothReport& report() const override { return report_; }

private:
    struct Stage {
        enum Kind { kNeighbours, kPass, kRound, kResolve } kind;
        std::uint32_t number;  // number of the pass or round
        std::uint32_t ahead;   // chunks that the stage before must be ahead
        std::uint32_t done = 0;
    };

    void plan_stages();
    [[nodiscard]] bool work(bool is_last, double next_low);
    [[nodiscard]] bool run(const Stage& stage, std::uint32_t chunk);
    void begin_backtracking(std::uint32_t chunk);
    Vec3 position(std::uint32_t v) const { return (*steps_.now)[v]; }
    void release_before(std::uint32_t chunk);
    void note_ready();
    void note_bytes();

    SmoothOptions options_;
    ChunkOrder order_;
    SurfaceWindow window_;
    Neighbours neighbours_;
    std::unique_ptr<Filter> filter_;
    double most_;             // farthest that a vertex may go along the sweep
    std::uint32_t held_ = 0;  // chunks that are held after their intersections are resolved
    bool is_last_ = false;
    double next_low_ = 0;
    std::uint32_t ready_ = 0, noted_ = 0, released_ = 0;
    std::optional<std::uint32_t> stuck_chunk_;
    SlidingArray<Vec3> positions_[2];
    SlidingArray<double> low_;  // low of each chunk along the sweep, smoothed or not
    StepLengths steps_;
    BacktrackRounds rounds_;
    IntersectionResolver resolver_;
    std::vector<Stage> stages_;
    SmoothReport report_;
};

}  // namespace regionmesh
