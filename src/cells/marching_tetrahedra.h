// The faces inside one labelled tetrahedron (Nielson and Franke 1997; P 3.2), and on one labelled triangle of the box.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "cells/kuhn.h"
#include "regionmesh/label.h"
#include "regionmesh/vec3.h"

namespace regionmesh {

/// A simplex of a tetrahedron or triangle by its corners as bits: 0b0101 is the edge between corners 0 and 2.
using CornerSet = std::uint8_t;

/// One face: each vertex is the centroid of a simplex; the face separates the labels of corners `first` and `second`,
/// and its normal points from first to second. On a triangle of the box `second` is not used: it is the exterior.
struct CaseFace {
    std::array<CornerSet, 3> vertices;
    std::uint8_t first, second;
};

/// The patch between two labels: a triangle, or a quad that is not cut yet. `turns`: its normal points from second to
/// first in a tetrahedron with the orientation of the first of Kuhn's (orientation() > 0).
struct CasePatch {
    std::array<CornerSet, 4> vertices;  // corners in cyclic order
    std::uint8_t vertex_count;          // 3 or 4
    std::uint8_t first, second;
    bool turns;

    /// The faces of the patch; a quad is cut along the diagonal from vertex `start`, 0 or 1.
    int cut(int start, bool turn, std::array<CaseFace, 2>& faces) const;
};

/// The diagonal that cuts a quad.
enum class QuadCuts {
    kBestQuality,  // the better worst quality at unit spacing
    kCones,  // all faces of a tetrahedron or triangle share one vertex: they stay embedded wherever vertices go in
             // their simplices (docs/explanation/smoothing.md)
};

/// The vertex of a quad, 0 or 1, whose diagonal gives the higher minimum quality; 0 in a draw.
int better_cut(const std::array<Vec3, 4>& quad);

/// Corners that share a label: bit e is set when the two corners of pair e differ. Pairs 01 02 03 12 13 23.
inline unsigned tetrahedron_pattern(Label a, Label b, Label c, Label d) {
    return unsigned(a != b) | unsigned(a != c) << 1 | unsigned(a != d) << 2 | unsigned(b != c) << 3 |
           unsigned(b != d) << 4 | unsigned(c != d) << 5;
}
/// Pairs 01 02 12.
inline unsigned triangle_pattern(Label a, Label b, Label c) {
    return unsigned(a != b) | unsigned(a != c) << 1 | unsigned(b != c) << 2;
}

/// The patches of all cases: none, one of three vertices (one corner against three), one of four (two against two),
/// or, for three labels and four, two quads and a triangle, and six quads. Patterns that no labels make are empty.
using TetrahedronPatches = std::array<std::vector<CasePatch>, 64>;
TetrahedronPatches make_tetrahedron_patches();

/// The patches of a triangle on the hull: one triangle, a triangle and a quad, or three quads, oriented like the
/// corners.
using TrianglePatches = std::array<std::vector<CasePatch>, 8>;
TrianglePatches make_triangle_patches();

/// All cases of the tetrahedron with corners at the given steps: no face for one label, 1 (one corner against three) or
/// 2 (two against two) for two labels, 5 for three, 12 for four. Patterns that no labels make are empty.
using TetrahedronCases = std::array<std::vector<CaseFace>, 64>;
TetrahedronCases make_tetrahedron_cases(const std::array<Step, 4>& corners, QuadCuts cuts = QuadCuts::kBestQuality);

/// All cases of a lattice triangle on the box: 1, 3 or 6 faces for 1, 2 or 3 labels, oriented like the corners.
using TriangleCases = std::array<std::vector<CaseFace>, 8>;
TriangleCases make_triangle_cases(const std::array<Step, 3>& corners, QuadCuts cuts = QuadCuts::kBestQuality);

}  // namespace regionmesh
