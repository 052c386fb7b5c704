// The faces inside one labelled tetrahedron (Nielson and Franke 1997; P 3.2), and on one labelled triangle of the box.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "regionmesh/base/label.h"
#include "regionmesh/tets/kuhn.h"

namespace regionmesh {

/// A simplex of a tetrahedron or triangle by its corners as bits: 0b0101 is the edge between corners 0 and 2.
using CornerSet = std::uint8_t;

/// One face: each vertex is the centroid of a simplex; the face separates the labels of corners `first` and `second`,
/// and its normal points from first to second. On a triangle of the box `second` is meaningless: the exterior.
struct CaseFace {
    std::array<CornerSet, 3> vertices;
    std::uint8_t first, second;
};

/// Which corners share a label: bit e set when the two corners of pair e differ. Pairs 01 02 03 12 13 23.
inline unsigned tetrahedron_pattern(Label a, Label b, Label c, Label d) {
    return unsigned(a != b) | unsigned(a != c) << 1 | unsigned(a != d) << 2 | unsigned(b != c) << 3 |
           unsigned(b != d) << 4 | unsigned(c != d) << 5;
}
/// Pairs 01 02 12.
inline unsigned triangle_pattern(Label a, Label b, Label c) {
    return unsigned(a != b) | unsigned(a != c) << 1 | unsigned(b != c) << 2;
}

/// All cases of the tetrahedron with corners at the given steps: 0, 2, 2 (one against three, two against two), 5 or 12
/// faces for 1 to 4 labels: 1, 2, 5, 12. Quads are cut along the diagonal that gives the better worst quality at unit
/// spacing. Patterns that no labels make are empty.
using TetrahedronCases = std::array<std::vector<CaseFace>, 64>;
TetrahedronCases make_tetrahedron_cases(const std::array<Step, 4>& corners);

/// All cases of a lattice triangle on the box: 1, 3 or 6 faces for 1, 2 or 3 labels, turned as the corners are.
using TriangleCases = std::array<std::vector<CaseFace>, 8>;
TriangleCases make_triangle_cases(const std::array<Step, 3>& corners);

}  // namespace regionmesh
