// How far the surface round each vertex has moved, and how far it may.
#pragma once

#include <algorithm>
#include <vector>

#include "regionmesh/mesh.h"

namespace regionmesh {

/// The surface round a vertex has moved by no more than its drift, as steps add up (Gueziec 1996, without the part
/// between the crossings of old and new edges).
class SurfaceDrift {
public:
    SurfaceDrift(std::uint32_t vertex_end, double most) : drift_(vertex_end, 0.0f), most_(most) {}

    float of(VertexId v) const { return drift_[index(v)]; }
    /// May the surface move by `step` where it has moved by `before`? Round faces below the quality bound it may move
    /// farther.
    bool may_move(float before, double step, bool is_poor) const {
        return before + step <= (is_poor ? kPoorShare * most_ : most_);
    }
    void set(VertexId v, float before, double step) { drift_[index(v)] = before + static_cast<float>(step); }

private:
    static constexpr double kPoorShare = 3;

    std::vector<float> drift_;
    double most_;
};

}  // namespace regionmesh
