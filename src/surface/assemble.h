// A mesh from arrays that are known to be consistent.
#pragma once

#include "regionmesh/mesh_arrays.h"

namespace regionmesh {

/// Node types of points on the box, or on the hull of tetrahedra, begin here (DREAM.3D's numbers).
inline constexpr int kFirstHullType = 10;

/// import_arrays() without its tests of the arrays.
LabelledMesh assemble(const MeshArrays& arrays);

}  // namespace regionmesh
