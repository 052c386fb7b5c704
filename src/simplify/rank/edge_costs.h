// Costs of the edges of a vertex by quadrics, four at a time.
#pragma once

#include <span>
#include <vector>

#include "simplify/placement/placement.h"
#include "simplify/placement/vertex_quadrics.h"

namespace regionmesh {

/// Costs of the edges from v to each of `to`, as least_cost() gives them, but in floats: to rank by. Each end that
/// would stay has every side of the box that the other has. `costs` gets a multiple of four.
void find_edge_costs(const Mesh& mesh, const VertexQuadrics& quadrics, VertexId v, std::span<const VertexId> to,
                     std::vector<EdgeCost>& costs);

}  // namespace regionmesh
