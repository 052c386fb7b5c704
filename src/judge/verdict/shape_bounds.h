// Bounds of the tests of shape, and the comparisons that they share.
#pragma once

#include "base/lanes.h"
#include "judge/tuning.h"

namespace regionmesh {

struct ShapeBounds {
    double min_quality = 0.1;                         // of modified faces; a star with faces below may keep as many
    double min_turn_cosine = kMinTurnCosine;          // between the normals of a face before and after
    double min_dihedral_cosine = kMinDihedralCosine;  // of the angle between two faces at an edge
};

/// Are these products of vectors above the bounds, which are given squared?
inline Mask2 are_above(Double2 products, Double2 bounds2) {
    return (products > both(0)) & (products * products > bounds2);
}

/// Do two faces keep their direction (no fold)? Given their normals before and after, with the squared lengths.
inline Mask2 keep_direction(const Lanes3<Double2>& old_normal, Double2 old_length2, const Lanes3<Double2>& normal,
                            Double2 length2, double min_turn_cosine) {
    return are_above(dot(old_normal, normal), both(min_turn_cosine * min_turn_cosine) * old_length2 * length2);
}

}  // namespace regionmesh
