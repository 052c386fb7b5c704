// Smoothing of a surface that comes in layer by layer, in a window that moves with it (DESIGN 8).
#pragma once

#include <vector>

#include "regionmesh/smooth_report.h"
#include "smooth/neighbours.h"
#include "smooth/nifpms.h"
#include "smooth/settle.h"
#include "smooth/step_back.h"

namespace regionmesh {

/// Pass k works one layer behind pass k - 1, the rounds of stepping back follow as if they were passes, and at the end
/// layers are held until no later one can reach them. Two places are kept for each vertex: pass k writes where pass
/// k - 2 did. What comes out depends on the layers, not on when they are asked for; and whether the surface comes in
/// layers or as one, the filters and rounds give the same places, bit for bit.
class Smoother {
public:
    /// Requires options.passes > 0.
    Smoother(const SmoothOptions& options, const LayerOrder& order);
    Smoother(const Smoother&) = delete;
    Smoother& operator=(const Smoother&) = delete;

    /// Where the caller adds the places, sides and faces of the next layer.
    SurfaceWindow& window() { return window_; }
    const SurfaceWindow& read_window() const { return window_; }
    /// The layer is complete; vertices to come lie at `plane` or beyond along the axis of the layers. Throws
    /// HeldTooFew.
    void end_layer(bool is_last, double plane = 0);

    /// Layers before this one are done: their places are final.
    std::uint32_t ready_end() const { return ready_; }
    Vec3 place(std::uint32_t v) const { return places_[1 - smooth_at_][v]; }
    /// Layers held at most, where they are released as soon as they are done.
    std::uint32_t most_layers() const;
    /// Lets go of layers that are done.
    void release_before(std::uint32_t layer);

    /// All that is not released lies here or beyond along the axis of the layers, however it ends.
    double floor() const;

    const SmoothReport& report() const { return report_; }

private:
    struct Stage {
        enum Kind { kNeighbours, kRelax, kMollify, kPredict, kRound, kSettle } kind;
        std::uint32_t number;  // of the pass or round
        std::uint32_t reach;   // layers ahead that the stage before must have done
        std::uint32_t done = 0;
    };

    void plan_stages();
    void run(const Stage& stage, std::uint32_t layer);
    void begin_stepping_back(std::uint32_t layer);
    void note_ready();
    void note_bytes();

    SmoothOptions options_;
    LayerOrder order_;
    double most_;             // farthest that a vertex may go along the axis
    std::uint32_t held_ = 0;  // layers that are held after they are settled
    int smooth_at_ = 0;       // which of the places the last pass writes
    bool is_last_ = false;
    double plane_ = 0;
    std::uint32_t ready_ = 0, noted_ = 0, released_ = 0;
    SurfaceWindow window_;
    SlidingArray<Vec3> places_[2];
    SlidingArray<double> low_;  // of each layer along the axis, now or before
    Neighbours neighbours_;
    Nifpms nifpms_;
    Stand stand_;
    StepBackRounds rounds_;
    Settling settling_;
    std::vector<Stage> stages_;
    SmoothReport report_;
};

}  // namespace regionmesh
