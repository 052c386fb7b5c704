// Cuts polygons of surface files into triangles.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "regionmesh/vec3.h"

namespace regionmesh {

/// Appends the triangles of a polygon of three or more corners, numbers of `points`, to `triangles`: two fewer than it
/// has corners, with its orientation. Up to 1024 corners, which need not be convex, it is cut ear by ear, the shortest
/// cut first, so a convex quad along its shorter diagonal; else in halves, as if it were convex. Neither the corner
/// that comes first makes a difference nor the direction: two polygons that lie back to back are cut alike. One that
/// touches itself at a corner from outside gets triangles that overlap.
void cut_polygon(const std::vector<Vec3>& points, std::span<const std::uint32_t> corners,
                 std::vector<std::array<std::uint32_t, 3>>& triangles);

}  // namespace regionmesh
