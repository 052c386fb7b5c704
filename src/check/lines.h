// Measures of the lines.
#pragma once

#include "mesh/mesh_part.h"
#include "regionmesh/check.h"

namespace regionmesh {

/// Sums over the vertices of lines.
struct LineTotals {
    std::uint64_t edges = 0, turns = 0;
    double length = 0, turned = 0;  // radians

    void append(const LineTotals& later) {
        edges += later.edges;
        turns += later.turns;
        length += later.length;
        turned += later.turned;
    }
    LineReport report() const;
};

/// Of the vertices of a part, or of all.
LineTotals sum_lines(const Mesh& mesh, const MeshPart* part, std::uint32_t threads);

LineReport measure_lines(const Mesh& mesh, std::uint32_t threads);

}  // namespace regionmesh
