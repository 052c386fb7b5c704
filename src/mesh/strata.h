// The stratum of a vertex or edge is its label set; sides of the box count (docs/reference/glossary.md).
#pragma once

#include "mesh/label_set.h"
#include "regionmesh/mesh.h"

namespace regionmesh {

/// The labels of the faces around v, and the sides of the box that v lies on.
LabelSet vertex_labels(const Mesh& mesh, VertexId v);

/// The labels of the faces at the edge. If the surface ends there (a label has a single face: the box was not capped,
/// or background has no faces to the exterior), sides that both ends lie on count too. Three or more labels: a *line*.
LabelSet edge_labels(const Mesh& mesh, VertexId u, VertexId v);

/// Sets Vertex::label_count of all vertices, on at most `threads` threads (0: one per core). It stays valid as long as
/// no stratum changes.
void count_labels(Mesh& mesh, std::uint32_t threads = 1);

}  // namespace regionmesh
