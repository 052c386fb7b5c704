// How far the surface round each vertex has moved, and how far it may.
#pragma once

#include <algorithm>
#include <vector>

#include "regionmesh/mesh.h"

namespace regionmesh {

/// How far the surface round a vertex has moved, as steps add up (Gueziec 1996): an estimate, without the part between
/// the crossings of old and new edges. Each vertex stays near its own part of the surface; ErrorBound has the proof.
class SurfaceDrift {
public:
    static constexpr double kPoorShare = 3;

    SurfaceDrift(std::uint32_t vertex_end, double most) : drift_(vertex_end, 0.0f), most_(most) {}

    float of(VertexId v) const { return drift_[index(v)]; }
    /// May the surface move by `step` where it has moved by `before`? Round faces below the quality bound it may move
    /// farther.
    bool may_move(float before, double step, bool is_poor) const {
        return before + step <= (is_poor ? kPoorShare * most_ : most_);
    }
    void set(VertexId v, float before, double step) { drift_[index(v)] = before + static_cast<float>(step); }

private:
    std::vector<float> drift_;
    double most_;
};

}  // namespace regionmesh
