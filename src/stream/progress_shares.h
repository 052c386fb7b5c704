// How much of a run is done, over all stages: an estimate for a progress line.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

namespace regionmesh {

/// In the order in which stages end. kMesh, kSmooth and kTiles go on side by side.
enum class WorkStage {
    kCount,
    kMesh,
    kSmooth,
    kTiles,
    kPasses,
    kTrim,
    kRemesh,
    kLines,
    kImprove,
    kVolumes,
    kCheck,
    kSamples
};

class ProgressShares {
public:
    /// Leaves out a stage that this run does not have.
    void leave_out(WorkStage stage) { weights_[at(stage)] = 0; }

    /// The stage is done up to `share`, 0 to 1. It does not go back.
    void advance(WorkStage stage, double share) {
        double& done = done_[at(stage)];
        done = std::max(done, std::min(share, 1.0));
    }

    /// Of the run, 0 to 1. Rises with advance(), and may fall with leave_out().
    double share() const {
        double done = 0, all = 0;
        for (std::size_t n = 0; n < kStages; ++n) {
            done += weights_[n] * done_[n];
            all += weights_[n];
        }
        return all > 0 ? done / all : 1;
    }

private:
    static constexpr std::size_t kStages = 12;
    static constexpr std::size_t at(WorkStage stage) { return static_cast<std::size_t>(stage); }

    // Seconds of each stage for 3.4 million faces of an atlas with 116 regions, decimated to a tenth on two cores.
    std::array<double, kStages> weights_{0.2, 1.5, 20, 24, 3.5, 0.6, 12, 4, 4, 3, 0.6, 0.4}, done_{};
};

}  // namespace regionmesh
