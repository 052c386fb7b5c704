// What a mesh must have according to the labels of its volume, independent of how the mesh was made.
#pragma once

#include <cstdint>
#include <vector>

#include "regionmesh/label_table.h"

namespace regionmesh {

/// docs/reference/check.md, "Against the labels". All three hold before and after smoothing and simplification.
struct LabelOracle {
    std::vector<std::int64_t> euler;            // one per dense label: Euler characteristic of the region's boundary
    std::uint64_t quadruple_points_inside = 0;  // lattice tetrahedra with four labels
    std::uint64_t region_pairs = 0;             // pairs of labels joined by a lattice edge
};

/// The same in the dense labels of another table; labels that it does not have are added to it.
LabelOracle relabelled(const LabelOracle& oracle, const LabelTable& labels, LabelTable& other);

}  // namespace regionmesh
