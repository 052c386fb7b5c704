// Positions whose means can be computed without rounding.
#pragma once

#include <vector>

#include "regionmesh/vec3.h"

namespace regionmesh {

/// Moves each coordinate to the nearest multiple of 12 units. A unit is 2^-51 times the power of two above the largest
/// coordinate along that axis, so no point moves farther than 5.4e-15 of it. The means of two, three and four such
/// points are exact if computed from differences, so faces cut out of tetrahedra with such corners do not cross,
/// however thin the tetrahedra are. Keeps the order of coordinates; equal ones stay equal. Requires finite coordinates.
void move_to_exact_grid(std::vector<Vec3>& points);

/// The power of two with the smallest ratio to `factor`, which is positive. Scaling by it is exact and reversible.
double nearest_power_of_two(double factor);

}  // namespace regionmesh
