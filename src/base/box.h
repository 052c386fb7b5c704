// Boxes of triangles, and how boxes lie to each other.
#pragma once

#include <array>

#include "regionmesh/vec3.h"

namespace regionmesh {

/// The bounding box of a triangle.
inline Box box_of(const std::array<Vec3, 3>& corners) {
    Box box;
    for (Vec3 p : corners) box.add(p);
    return box;
}

/// Whether they have a point in common, on their sides at least. Without branches, which would be mispredicted.
inline bool overlap(const Box& a, const Box& b) {
    return (a.low.x <= b.high.x) & (a.low.y <= b.high.y) & (a.low.z <= b.high.z) & (b.low.x <= a.high.x) &
           (b.low.y <= a.high.y) & (b.low.z <= a.high.z);
}

/// The common part of two boxes.
inline Box common(const Box& a, const Box& b) { return {max(a.low, b.low), min(a.high, b.high)}; }

/// Whether no point of `inner` is outside of `outer`.
inline bool is_within(const Box& inner, const Box& outer) {
    for (int axis = 0; axis < 3; ++axis)
        if (inner.low[axis] < outer.low[axis] || inner.high[axis] > outer.high[axis]) return false;
    return true;
}

/// No branches: they would be mispredicted.
inline bool is_within(Vec3 p, const Box& box) {
    return (p.x >= box.low.x) & (p.x <= box.high.x) & (p.y >= box.low.y) & (p.y <= box.high.y) & (p.z >= box.low.z) &
           (p.z <= box.high.z);
}

/// Distance from a point to the nearest one of the box; infinite for an empty box.
inline double squared_distance(const Box& box, Vec3 p) {
    const Vec3 outside = max(max(box.low - p, p - box.high), {});
    return length2(outside);
}

}  // namespace regionmesh
