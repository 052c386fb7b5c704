// Models of files that have no background, beside the volume that they were made from.
#pragma once

#include "regionmesh/formats.h"
#include "regionmesh/regionmesh.h"

namespace regionmesh::cli {

/// STL files have the exterior where the model had background or the exterior. Gives `background` to the faces of the
/// exterior that do not lie on a side of the lattice, as reconstruct had it. Requires a model without that label.
void restore_background(MeshFile& file, const Lattice& lattice, InputLabel background);

}  // namespace regionmesh::cli
