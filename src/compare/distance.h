// Distances from a point to a segment and to a triangle.
#pragma once

#include <algorithm>
#include <array>

#include "regionmesh/vec3.h"

namespace regionmesh {

/// Squared distance from p to the segment a b, which may be a point.
inline double squared_distance(Vec3 p, Vec3 a, Vec3 b) {
    const Vec3 ab = b - a, ap = p - a;
    const double along = dot(ap, ab), whole = length2(ab);
    if (along <= 0 || whole == 0) return length2(ap);
    return along >= whole ? length2(p - b) : length2(ap - along / whole * ab);
}

/// Squared distance from p to the triangle t, which may be a segment or a point. Where it is at least `bound`, returns
/// any number that is at least `bound`. The relative error of the distance is a few roundings; for a sliver whose angle
/// at t[0] is within 1e-8 of 0 or 180 degrees the error is 1e-8 of its length.
inline double squared_distance(Vec3 p, const std::array<Vec3, 3>& t, double bound = HUGE_VAL) {
    const Vec3 ab = t[1] - t[0], ac = t[2] - t[0], bc = t[2] - t[1], ap = p - t[0];
    const Vec3 normal = cross(ab, ac);
    const double normal2 = length2(normal);
    // The normal of a thinner triangle is mostly rounding, and its edges approximate its inside as well.
    const bool is_thin = normal2 <= 1e-16 * length2(ab) * length2(ac);
    bool beyond_ab = true, beyond_bc = true, beyond_ca = true;
    if (!is_thin) {
        const double height = dot(normal, ap);
        if (height * height >= bound * normal2) return bound;
        beyond_ab = dot(normal, cross(ab, ap)) < 0;
        beyond_bc = dot(normal, cross(bc, p - t[1])) < 0;
        beyond_ca = dot(normal, cross(ac, ap)) > 0;
        if (!beyond_ab && !beyond_bc && !beyond_ca) return height * height / normal2;
    }
    // The nearest point lies on an edge that p is beyond.
    double nearest = HUGE_VAL;
    if (beyond_ab) nearest = squared_distance(p, t[0], t[1]);
    if (beyond_bc) nearest = std::min(nearest, squared_distance(p, t[1], t[2]));
    if (beyond_ca) nearest = std::min(nearest, squared_distance(p, t[2], t[0]));
    return nearest;
}

}  // namespace regionmesh
