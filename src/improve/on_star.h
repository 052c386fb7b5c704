// Places on the faces round a vertex.
#pragma once

#include <optional>

#include "judge/edge_star.h"

namespace regionmesh {

/// The point above or below `target` along `up` on the star of faces from `apex` over the link; none where the target
/// lies beyond the link. A sum of steps from the apex to corners of one face keeps coordinates that all of them have.
inline std::optional<Vec3> point_on_star(const EdgeStar& star, Vec3 apex, Vec3 target, Vec3 up) {
    const Vec3 step = target - apex;
    for (int n = 0; n < star.face_count(); ++n) {
        const Vec3 to_a = star.at_a(n) - apex, to_b = star.at_b(n) - apex;
        const double turn = dot(up, cross(to_a, to_b));
        if (turn <= 0) continue;
        const double s = dot(up, cross(step, to_b)) / turn, t = dot(up, cross(to_a, step)) / turn;
        if (s >= 0 && t >= 0 && s + t < 1) return apex + (s * to_a + t * to_b);
    }
    return {};
}

}  // namespace regionmesh
