// One pass of the filters that move a vertex toward the mean of its neighbours (P eq. 2).
#pragma once

#include "regionmesh/smooth_options.h"
#include "smooth/neighbours.h"

namespace regionmesh {

/// Share of the way that pass `pass` (from 0) goes: lambda, and every other time mu for Taubin's filter.
double relax_factor(const SmoothOptions& options, std::uint32_t pass);

/// v' = v + factor * (mean of the neighbours - v) for the vertices of a range, from one array of places to another. On
/// a side of the box the coordinate stays, to the last bit.
void relax(const SurfaceWindow& window, const Neighbours& neighbours, NumberRange vertices, double factor,
           const SlidingArray<Vec3>& from, SlidingArray<Vec3>& to, std::uint32_t threads);

/// Puts back the coordinates that a vertex on sides of the box keeps: all, on a hull of any shape.
inline void keep_on_sides(SideSet sides, Vec3 before, Vec3& p) {
    if (sides & (kOnHull | kPinned)) p = before;
    for (int axis = 0; axis < 3; ++axis)
        if (sides >> (2 * axis) & 3) p[axis] = before[axis];
}

}  // namespace regionmesh
