// From the axes of the lattice to space.
#pragma once

#include "regionmesh/model/model.h"
#include "regionmesh/volume/lattice.h"

namespace regionmesh {

/// Applies the direction of the lattice, and its origin where the direction is not that of the axes; faces are turned
/// where it mirrors.
void place_in_space(Model& model, const Lattice& lattice);

}  // namespace regionmesh
