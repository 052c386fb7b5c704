// What the labels of a volume say its model must be, whatever was done to the model.
#pragma once

#include <cstdint>
#include <vector>

namespace regionmesh {

/// DESIGN 4, oracles (b), (c), (d); all three hold before and after smoothing and decimation.
struct LabelOracle {
    std::vector<std::int64_t> euler;            // by dense label: Euler characteristic of the region's boundary
    std::uint64_t quadruple_points_inside = 0;  // lattice tetrahedra with four labels
    std::uint64_t region_pairs = 0;             // pairs of labels joined by a lattice edge
};

}  // namespace regionmesh
