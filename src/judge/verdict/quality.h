// The quality of the faces that a collapse changes.
#pragma once

#include "judge/edge_star.h"
#include "judge/verdict/shape_bounds.h"

namespace regionmesh {

/// The least quality, to the third power, of the faces that a vertex leaves when it goes to a neighbour; 0 when a face
/// folds, or gets below the bound where the fan had no such faces: as in test_quality. `around` is that of
/// gather_vertex or of the edge to the neighbour.
double fan_quality3(const Mesh& mesh, const EdgeStar& around, VertexId target, Vec3 at_target,
                    const ShapeBounds& bounds);

}  // namespace regionmesh
