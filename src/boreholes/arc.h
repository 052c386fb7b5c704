// Arcs of circles between two directions: the method of minimum curvature.
#pragma once

#include <algorithm>
#include <cmath>

#include "regionmesh/vec3.h"

namespace regionmesh::formats {

/// Radians, below which an arc is a line.
inline constexpr double kStraight = 1e-6;

inline double angle_between(Vec3 from, Vec3 to) { return 2 * std::asin(std::min(1.0, length(to - from) / 2)); }

/// The vector along the arc from a direction to another, for a length of the arc. Directions are of unit length.
inline Vec3 along_arc(Vec3 from, Vec3 to, double measured) {
    const double angle = angle_between(from, to);
    const double factor = angle < kStraight ? 1 : 2 / angle * std::tan(angle / 2);
    return (from + to) * (measured / 2 * factor);
}

/// The direction at a share of the arc between two.
inline Vec3 between(Vec3 from, Vec3 to, double share) {
    const double angle = angle_between(from, to);
    if (angle < kStraight) return from;
    return (from * std::sin((1 - share) * angle) + to * std::sin(share * angle)) / std::sin(angle);
}

}  // namespace regionmesh::formats
