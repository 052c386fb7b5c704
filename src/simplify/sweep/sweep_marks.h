// Which vertices a sweep of half-edge collapses visits, and how many sweeps are made.
#pragma once

#include <cstdint>
#include <vector>

#include "regionmesh/mesh.h"
#include "simplify/tuning.h"

namespace regionmesh {

/// The neighbourhood of a collapse stays as it is until the next sweep, so that collapses spread evenly. A vertex that
/// could not be removed is settled until something near it changes.
class SweepMarks {
public:
    explicit SweepMarks(std::uint32_t vertices) : seen_(vertices, 0) {}

    void begin_sweep() { ++sweep_; }
    /// Has the star of the vertex changed in this sweep?
    bool is_touched(VertexId v) const { return seen_[index(v)] == sweep_; }
    bool is_due(VertexId v) const { return seen_[index(v)] != kSettled && !is_touched(v); }
    void touch(VertexId v) { seen_[index(v)] = sweep_; }
    void settle(VertexId v) { seen_[index(v)] = kSettled; }

private:
    static constexpr std::uint8_t kSettled = 255;
    static_assert(kMostSweeps + 2 * kMostFaultSweeps < kSettled);

    std::vector<std::uint8_t> seen_;  // by vertex: the sweep in which its star changed, or kSettled
    std::uint8_t sweep_ = 0;
};

/// Calls sweep(), which returns how many vertices it removed, as long as a whole sweep stays above the target and
/// enough faces go, two with each vertex.
template <class Sweep>
void sweep_above(std::uint32_t target_faces, const Mesh& mesh, Sweep&& sweep) {
    for (int n = 0; n < kMostSweeps && mesh.face_count() * kLeastSweepLeft > target_faces; ++n) {
        const std::uint32_t before = mesh.face_count();
        if (2 * sweep() < kLeastSweepGain * before) break;
    }
}

}  // namespace regionmesh
