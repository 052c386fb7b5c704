// Backtracking: smoothed vertices go less far where a face would turn or lose quality (docs/explanation/smoothing.md).
#pragma once

#include <cstdint>

#include "regionmesh/smooth.h"
#include "smooth/surface_window.h"
#include "smooth/tuning.h"

namespace regionmesh {

using smoothing::kFullBacktrack;

/// Where smoothing takes each vertex, and how far it backtracks from there. All arrays have the vertex numbers of the
/// window.
struct StepLengths {
    SlidingArray<std::uint8_t> backtrack;  // steps that a vertex goes less far: 0 to kFullBacktrack, where it stays put
    SlidingArray<std::uint8_t> wanted;     // steps requested by the faces seen so far in the current round
    SlidingArray<Vec3>* smooth = nullptr;  // positions after the last pass of the filter
    SlidingArray<Vec3>* now = nullptr;     // positions at the current step lengths

    /// Sets how far the vertex backtracks, and moves it there.
    void set_backtrack(const SurfaceWindow& window, std::uint32_t v, std::uint8_t steps);
};

/// The fault in the shape of a face that has moved.
enum class ShapeFault : std::uint8_t { kNone, kTurned, kQuality };

/// kTurned when the normal turns by 90 degrees or more; kQuality when the quality falls below the bound, or, for a face
/// below the bound before, to less than half of what it was.
ShapeFault shape_fault(const std::array<Vec3, 3>& before, const std::array<Vec3, 3>& after, double min_quality);

/// Counts of faults with all vertices at their smoothed positions.
struct FaultCounts {
    std::uint64_t turned = 0, low_quality = 0;
};

/// One round over the faces of a chunk. In the first round a faulty face requests the fewest steps of backtracking at
/// which it would have no fault if all three vertices took them; in later rounds it requests kRoundStep more. Vertices
/// move when both chunks that use them have made their requests: so a round on chunk n needs the round before on chunk
/// n + 1, and no result depends on the order of faces.
class BacktrackRounds {
public:
    static constexpr std::uint32_t kRounds = smoothing::kRounds;
    static constexpr std::uint8_t kRoundStep = smoothing::kRoundStep;

    BacktrackRounds(const SurfaceWindow& window, StepLengths& steps, const SmoothOptions& options)
        : window_(window), steps_(steps), options_(options) {}

    /// Rounds count from 0; `is_last` says that no chunk follows.
    void run(std::uint32_t round, std::uint32_t chunk, bool is_last);
    const FaultCounts& faults() const { return faults_; }

private:
    struct Request {
        std::uint32_t face;
        std::uint8_t steps;  // in all in the first round, more than now in the others
        ShapeFault fault;
    };
    std::uint8_t first_valid_backtrack(const ChunkFace& face) const;
    void apply_requests(NumberRange vertices);

    const SurfaceWindow& window_;
    StepLengths& steps_;
    const SmoothOptions& options_;
    FaultCounts faults_;
};

/// The position between the two ends after `backtrack` steps from `smooth` toward `origin`.
inline Vec3 position_at(Vec3 origin, Vec3 smooth, std::uint8_t backtrack) {
    if (backtrack == 0) return smooth;
    if (backtrack >= kFullBacktrack) return origin;
    return origin + (1 - backtrack / static_cast<double>(kFullBacktrack)) * (smooth - origin);
}

}  // namespace regionmesh
