// Where a merged vertex goes, and what that costs.
#pragma once

#include "regionmesh/label.h"
#include "simplify/quadric.h"

namespace regionmesh {

struct Placement {
    Vec3 position;
    double cost;  // squared length times area
};

/// Share of the sum of weights that draws toward the middle of the edge.
inline constexpr double kRegularisation = 1e-3;

/// Share of weight times squared length that is added to a cost when edges are ranked: of edges that cost about the
/// same the shorter goes first. Faces stay rounder, and far fewer collapses are refused (docs/decimate.md).
inline constexpr double kLengthShare = 3e-4;

/// The two ends of an edge, each with its quadric relative to itself. `stays` has every side that `goes` has.
struct EdgeEnds {
    Vec3 goes, stays;
    const PackedQuadric &goes_quadric, &stays_quadric;
    SideSet stays_sides;
};

/// The least cost, regularised toward the middle of the edge so that flat neighbourhoods have one answer; on sides of
/// the box the merged vertex keeps the coordinate of `stays` exactly.
Placement place(const EdgeEnds& edge);

/// The cost of a given place.
double cost_at(const EdgeEnds& edge, Vec3 position);

/// Both quadrics together, relative to `origin`.
Quadric merged_quadric(const EdgeEnds& edge, Vec3 origin);

}  // namespace regionmesh
