// A model as a single layer.
#pragma once

#include <vector>

#include "regionmesh/mesh.h"
#include "smooth/surface_window.h"

namespace regionmesh {

/// Adds the vertices and faces that are alive, in their order; the caller ends the layer. Fixed vertices are said to
/// lie on all sides of the box: so they stay. Returns the number in the window of each vertex.
std::vector<std::uint32_t> add_mesh(const Mesh& mesh, SurfaceWindow& window);

}  // namespace regionmesh
