// Points whose means can be computed without rounding.
#pragma once

#include <vector>

#include "regionmesh/vec3.h"

namespace regionmesh {

/// Moves points to the nearest multiples of 12 units in each coordinate. A unit is 2^-51 of the power of two above the
/// largest absolute coordinate; points move by less than 3e-15 of that. The means of two, three and four such points
/// are exact if they are computed from differences. So faces cut from tetrahedra with such corners never cross, however
/// thin the tetrahedra are. Equal coordinates stay equal, and the order of coordinates is kept. Requires finite
/// coordinates.
void move_to_exact_grid(std::vector<Vec3>& points);

/// The power of two nearest to a positive factor, in ratio: multiplying coordinates by it is exact and reversible.
double nearest_power_of_two(double factor);

}  // namespace regionmesh
