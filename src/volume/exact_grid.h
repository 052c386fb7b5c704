// Places whose means can be computed without rounding.
#pragma once

#include <vector>

#include "regionmesh/vec3.h"

namespace regionmesh {

/// Moves points to the nearest multiples of 12 units in each coordinate, a unit being the 2^51st part of the power of
/// two above the largest of them: by less than 3e-15 of that. The means of two, three and four such points are then
/// exact, as long as they are taken from differences; so what is cut out of tetrahedra with such corners crosses
/// nothing, however thin they are. Equal coordinates stay equal, and no two change places. Requires finite coordinates.
void move_to_exact_grid(std::vector<Vec3>& points);

/// The power of two that is nearest to a positive factor, in ratio: coordinates times that lose nothing, and come back.
double nearest_power_of_two(double factor);

}  // namespace regionmesh
