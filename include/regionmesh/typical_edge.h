// The length that stands for the sample spacing where a model does not say.
#pragma once

#include "regionmesh/mesh.h"

namespace regionmesh {

/// Edge of an equilateral face of mean area; 1 for a model without faces.
double typical_edge(const Mesh& mesh);

}  // namespace regionmesh
