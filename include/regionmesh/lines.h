// Measures of the triple lines.
#pragma once

#include <cstdint>

#include "regionmesh/mesh.h"

namespace regionmesh {

/// Of the lines where three regions meet, inside the box.
struct LineReport {
    std::uint64_t edges = 0;
    double length = 0;
    double mean_turning_angle = 0;  // degrees, between consecutive edges, over the vertices inside lines
};

LineReport measure_lines(const Mesh& mesh);

}  // namespace regionmesh
