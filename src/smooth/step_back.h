// How smoothed vertices step back where a face would turn over or lose its quality (DESIGN 8, "guarded").
#pragma once

#include <cstdint>

#include "regionmesh/smooth_options.h"
#include "smooth/surface_window.h"

namespace regionmesh {

/// Steps from a vertex's smoothed place (level 0) to where it came from (kFullyBack).
inline constexpr std::uint8_t kFullyBack = 8;

/// The smoothed places, how far each vertex has stepped back, and where it stands for that.
struct Stand {
    SlidingArray<std::uint8_t> level;
    SlidingArray<std::uint8_t> wanted;  // level asked for by the faces seen so far in the round at hand
    SlidingArray<Vec3>* smooth = nullptr;
    SlidingArray<Vec3>* now = nullptr;

    /// Puts the vertex at the level.
    void set_level(const SurfaceWindow& window, std::uint32_t v, std::uint8_t to);
};

/// What is wrong with the shape of a face that has moved.
enum class ShapeFault : std::uint8_t { kNone, kTurned, kQuality };

/// kTurned when the normal turns by 90 degrees or more; kQuality when it falls below the bound, or, where it was below
/// before, to less than half of what it was.
ShapeFault shape_fault(const std::array<Vec3, 3>& before, const std::array<Vec3, 3>& after, double min_quality);

/// Counts of faults found with all vertices at their smoothed places.
struct FaultCounts {
    std::uint64_t turned = 0, low_quality = 0;
};

/// One round over the faces of a layer. In the first round a faulty face asks its vertices for the first level at which
/// it would be sound if all three had it; in the others for kRoundStep more. Vertices follow when both layers that use
/// them have asked: so a round on layer n needs the round before on layer n + 1, and no result depends on the order.
class StepBackRounds {
public:
    static constexpr std::uint32_t kRounds = 3;
    static constexpr std::uint8_t kRoundStep = 2;

    StepBackRounds(const SurfaceWindow& window, Stand& stand, const SmoothOptions& options)
        : window_(window), stand_(stand), options_(options) {}

    /// Rounds count from 0; `is_last` says that no layer follows.
    void run(std::uint32_t round, std::uint32_t layer, bool is_last);
    const FaultCounts& faults() const { return faults_; }

private:
    struct Wish {
        std::uint32_t face;
        std::uint8_t level;  // or how much more, after the first round
        ShapeFault fault;
    };
    std::uint8_t first_sound_level(const WindowFace& face) const;
    void settle(NumberRange vertices);

    const SurfaceWindow& window_;
    Stand& stand_;
    const SmoothOptions& options_;
    FaultCounts faults_;
};

/// The place at a level between the two ends.
inline Vec3 stepped_back(Vec3 origin, Vec3 smooth, std::uint8_t level) {
    if (level == 0) return smooth;
    if (level >= kFullyBack) return origin;
    return origin + (1 - level / static_cast<double>(kFullyBack)) * (smooth - origin);
}

}  // namespace regionmesh
