// How far the surface round each vertex has moved, and how far it may.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "judge/edge_star.h"
#include "regionmesh/mesh.h"

namespace regionmesh {

/// How far a merged vertex at p is from the planes of the faces that move, or from the end that goes farther.
inline double step_to(const EdgeStar& star, Vec3 p) {
    double step = 0;
    for (int n = 0; n < star.face_count(); ++n) {
        const StarPair& pair = star.pairs[n / 2];
        const double size = std::sqrt(pair.old_length2[n % 2]);
        const Vec3 normal = pair.old_normal[n % 2];
        const double height = std::abs(dot(normal, p - star.at_apex(n)));
        step = std::max(step, size > 0 ? height / size : HUGE_VAL);
    }
    return std::min(step, std::max(length(p - star.at_goes), length(p - star.at_stays)));
}

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
    /// Where vertices were added: they have not moved.
    void grow(std::uint32_t vertex_end) { drift_.resize(std::max<std::size_t>(vertex_end, drift_.size()), 0.0f); }
    void set(VertexId v, float before, double step) { drift_[index(v)] = before + static_cast<float>(step); }

private:
    std::vector<float> drift_;
    double most_;
};

}  // namespace regionmesh
