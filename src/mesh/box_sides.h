// The sides of a box on which points lie.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "regionmesh/label.h"
#include "regionmesh/vec3.h"

namespace regionmesh {

/// Three axes of a box, in the order of the coordinates, and which of them point against theirs.
struct AxesByCoordinate {
    std::array<std::size_t, 3> axes{0, 1, 2};
    std::array<bool, 3> are_reversed{};
};

/// Each coordinate in turn gets the axis that runs along it most, of those left. They are right-handed.
inline AxesByCoordinate axes_by_coordinate(const std::array<Vec3, 3>& along) {
    AxesByCoordinate found;
    auto& [axes, are_reversed] = found;
    std::array<Vec3, 3> taken;
    for (int coordinate = 0; coordinate < 3; ++coordinate) {
        const auto next = axes.begin() + coordinate;
        const auto nearest = std::ranges::max_element(next, axes.end(), {},
                                                      [&](std::size_t n) { return std::abs(along[n][coordinate]); });
        std::rotate(next, nearest, nearest + 1);
        are_reversed[static_cast<std::size_t>(coordinate)] = along[*next][coordinate] < 0;
        taken[static_cast<std::size_t>(coordinate)] = along[*next][coordinate] < 0 ? -along[*next] : along[*next];
    }
    if (dot(cross(taken[0], taken[1]), taken[2]) < 0) are_reversed[2] = !are_reversed[2];
    return found;
}

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

/// The sides, of those that both ends of an edge lie on, on which a face with these labels may end there, where the box
/// is open: not the side that it lies in.
inline SideSet open_sides(SideSet of_ends, const std::array<Label, 2>& labels) {
    for (const Label label : labels)
        if (is_exterior(label)) of_ends &= static_cast<SideSet>(~(1u << side_of(label)));
    return of_ends;
}

/// Whether so many regions and these sides may meet at a point of a sound model: four labels in all.
inline bool may_meet(int regions, SideSet sides) { return regions + std::popcount(sides) <= 4; }

}  // namespace regionmesh
