// Volumes of regions from their faces.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "base/triangle.h"
#include "regionmesh/mesh.h"

namespace regionmesh {

/// Adds the volume of the cone from `apex` over a face to its first label, and subtracts it from the second: over a
/// closed boundary the sum is the volume. The apex is a corner of the first face that is added: far from the surface
/// large cones would cancel, and so would area vectors that were not taken from corner to corner. `volumes` is by dense
/// label and grows as needed; exteriors have no entry.
inline void add_cone(std::vector<double>& volumes, std::optional<Vec3>& apex, const std::array<Label, 2>& labels,
                     Vec3 a, Vec3 b, Vec3 c) {
    if (!apex) apex = a;
    const double cone = dot(a - *apex, area_vector(a, b, c)) / 6;
    for (int side = 0; side < 2; ++side) {
        if (is_exterior(labels[side])) continue;
        if (labels[side] >= volumes.size()) volumes.resize(labels[side] + 1);
        volumes[labels[side]] += side == 0 ? cone : -cone;
    }
}

/// Volumes of all regions by dense label, length^3; meaningful for regions with a closed boundary.
std::vector<double> region_volumes(const Mesh& mesh);

}  // namespace regionmesh
