// Transforms a mesh from the axes of the lattice to space.
#pragma once

#include "regionmesh/lattice.h"
#include "regionmesh/mesh.h"

namespace regionmesh {

/// The lattice for meshing: positions are index times spacing, plus the origin if the direction matrix is the identity.
inline Lattice meshing_lattice(const Lattice& lattice) {
    Lattice result = lattice;
    if (!lattice.is_axis_aligned()) result.origin = {};
    return result;
}

/// Divides z by the power of two that it was multiplied by.
void unscale_z(Mesh& mesh, double scale_z);

/// Applies direction and origin of the lattice where the direction is not the identity. Flips the faces if it mirrors;
/// sides of the box are afterwards those across the coordinates that they are nearest to.
void place_in_space(Mesh& mesh, const Lattice& lattice);

}  // namespace regionmesh
