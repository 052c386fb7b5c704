// The simplex of an unsmoothed vertex, found by trying all kinds: for meshes that have only positions.
#pragma once

#include <cmath>

#include "regionmesh/error.h"
#include "smooth/lattice/lattice_simplex.h"

namespace regionmesh::test {

inline LatticeSimplex simplex_at(Vec3 position, const LatticeFrame& frame) {
    for (std::uint8_t kind = 0; kind < kKindCount; ++kind) {
        LatticeSimplex simplex{.base = {}, .kind = kind};
        for (int axis = 0; axis < 3; ++axis)
            simplex.base[axis] =
                std::round((position[axis] - frame.origin[axis]) / frame.spacing[axis] - kCentroids[kind][axis]);
        if (centroid_in(simplex, frame) == position) return simplex;
    }
    throw Error(ErrorCode::kInput, "test: not the centroid of a lattice simplex");
}

}  // namespace regionmesh::test
