// The stratum of a vertex or edge is its label set; exterior sides count (DESIGN 5).
#pragma once

#include "mesh/label_set.h"
#include "regionmesh/mesh.h"

namespace regionmesh {

/// Labels of the faces round v, and the sides of the box that v lies on.
LabelSet vertex_labels(const Mesh& mesh, VertexId v);

/// Labels of the faces at the edge. Where the surface ends there (a label has one face only: the box was not capped, or
/// the faces of a background were not made), the sides that both ends lie on count too. Three or more: a *line*.
LabelSet edge_labels(const Mesh& mesh, VertexId u, VertexId v);

/// Sets Vertex::label_count of all vertices. It stays right as long as no stratum changes.
void count_labels(Mesh& mesh);

}  // namespace regionmesh
