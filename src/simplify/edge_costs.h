// What the edges of a vertex cost, four at a time.
#pragma once

#include <span>
#include <vector>

#include "simplify/vertex_quadrics.h"

namespace regionmesh {

/// The cost of an edge, the sum of the weights of its ends' quadrics, and what the edge is ranked by: its cost and
/// kLengthShare of what its whole length would cost.
struct EdgeCost {
    float cost, weight, rank;
};

/// Costs of the edges from v to each of `to`, as place() gives them, but in floats: to rank by. Each end that would
/// stay has every side of the box that the other has. `costs` gets a multiple of four.
void find_edge_costs(const Mesh& mesh, const VertexQuadrics& quadrics, VertexId v, std::span<const VertexId> to,
                     std::vector<EdgeCost>& costs);

}  // namespace regionmesh
