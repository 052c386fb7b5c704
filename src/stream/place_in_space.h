// From the axes of the lattice to space.
#pragma once

#include "regionmesh/lattice.h"
#include "regionmesh/mesh.h"

namespace regionmesh {

/// The lattice to mesh on: positions are index times spacing, and an origin is added at once where no direction matrix
/// comes between.
inline Lattice meshing_lattice(const Lattice& lattice) {
    Lattice result = lattice;
    if (!lattice.is_axis_aligned()) result.origin = {};
    return result;
}

/// Applies the direction of the lattice, and its origin where the direction is not that of the axes; faces are turned
/// where it mirrors.
void place_in_space(Mesh& mesh, const Lattice& lattice);

}  // namespace regionmesh
