// Exact orientation and intersection of triangles, with cheap tests first. No epsilon: the result is that of exact
// arithmetic on the given coordinates.
#pragma once

#include <cmath>

#include "regionmesh/vec3.h"

namespace regionmesh {

/// Exact and slow; call orientation() instead.
int exact_orientation(Vec3 a, Vec3 b, Vec3 c, Vec3 d);

/// Sign of the determinant of b - a, c - a, d - a: +1 if d lies on the side to which the normal of a, b, c points.
/// The filter is Shewchuk's (1997) bound on the rounding error of the determinant.
inline int orientation(Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
    const Vec3 u = a - d, v = b - d, w = c - d;
    const double vw = v.x * w.y, wv = w.x * v.y, wu = w.x * u.y, uw = u.x * w.y, uv = u.x * v.y, vu = v.x * u.y;
    const double determinant = u.z * (vw - wv) + v.z * (wu - uw) + w.z * (uv - vu);
    const double permanent = std::abs(u.z) * (std::abs(vw) + std::abs(wv)) +
                             std::abs(v.z) * (std::abs(wu) + std::abs(uw)) +
                             std::abs(w.z) * (std::abs(uv) + std::abs(vu));
    const double bound = 7.7715611723761027e-16 * permanent;
    // Seen from d, a b c is clockwise when d lies where its normal points: hence the change of sign.
    if (determinant > bound) return -1;
    if (determinant < -bound) return 1;
    return permanent == 0 ? 0 : exact_orientation(a, b, c, d);
}

/// Is out . step positive by far more than its rounding error? Then p + step lies in front of the plane through p with
/// normal `out`, for any point p.
inline bool is_ahead(Vec3 out, Vec3 step) {
    const double x = out.x * step.x, y = out.y * step.y, z = out.z * step.z;
    return x + y + z > 1e-10 * (std::abs(x) + std::abs(y) + std::abs(z));
}

/// A triangle's three corners.
struct Triangle {
    Vec3 a, b, c;
};

/// Do the three corners lie on one line? Exact. True, too, if a corner is not finite.
bool is_degenerate(const Triangle& t);

/// Two triangles without a common corner: do they meet at all, touching included? Requires neither is degenerate.
bool meet(const Triangle& s, const Triangle& t);

/// Triangles p a b and p x y: do they meet outside p? Requires that neither is degenerate.
bool meet_beyond_vertex(Vec3 p, Vec3 a, Vec3 b, Vec3 x, Vec3 y);

/// Triangles p q a and p q x: do they meet outside the edge p q, that is, lie in one plane on the same side of it?
bool meet_beyond_edge(Vec3 p, Vec3 q, Vec3 a, Vec3 x);

}  // namespace regionmesh
