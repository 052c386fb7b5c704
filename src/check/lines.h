// Measures of the lines.
#pragma once

#include "mesh/star_edges.h"
#include "regionmesh/check.h"

namespace regionmesh {

/// Sums over the vertices of lines inside the box. An edge counts at the first of its ends.
class LineTotals {
public:
    /// Requires the edges at v.
    void add(const Mesh& mesh, VertexId v, const StarEdges& edges);
    void append(const LineTotals& later);
    LineReport report() const;

private:
    std::uint64_t edges_ = 0, turns_ = 0;
    double length_ = 0, turned_ = 0;  // radians
};

}  // namespace regionmesh
