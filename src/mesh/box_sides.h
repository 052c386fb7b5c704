// On which sides of a box points lie.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "regionmesh/label.h"
#include "regionmesh/vec3.h"

namespace regionmesh {

/// The sides of the box whose planes contain all the points, within the tolerance: a length, 0 for exactly.
template <class Points>
SideSet sides_at(const Points& points, const Box& box, double tolerance) {
    SideSet sides = 0;
    for (int side = 0; side < 6; ++side) {
        const int axis = side / 2;
        const double plane = (side % 2 == 0 ? box.low : box.high)[axis];
        if (std::ranges::all_of(points, [&](Vec3 p) { return std::abs(p[axis] - plane) <= tolerance; }))
            sides |= static_cast<SideSet>(1u << side);
    }
    return sides;
}

/// Of the sides that both ends of an edge lie on, those on which a face with these labels may end there, where the box
/// is open: not the side that it lies in.
inline SideSet open_sides(SideSet of_ends, const std::array<Label, 2>& labels) {
    for (const Label label : labels)
        if (is_exterior(label)) of_ends &= static_cast<SideSet>(~(1u << side_of(label)));
    return of_ends;
}

/// Whether so many regions and these sides may meet at a point of a sound model: four labels in all.
inline bool may_meet(int regions, SideSet sides) { return regions + std::popcount(sides) <= 4; }

}  // namespace regionmesh
