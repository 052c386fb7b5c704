// The place of least cost for a merged vertex, by the quadrics of its two ends.
#pragma once

#include "regionmesh/label.h"
#include "simplify/placement/quadric.h"
#include "simplify/tuning.h"

namespace regionmesh {

struct LeastCost {
    Vec3 position;
    double cost;  // squared length times area
};

/// The two ends of an edge, each with its quadric relative to itself. `stays` has every side that `goes` has.
struct EdgeEnds {
    Vec3 goes, stays;
    const PackedQuadric &goes_quadric, &stays_quadric;
    SideSet stays_sides;
};

/// The least cost, regularised toward the middle of the edge so that flat neighbourhoods have one answer; on sides of
/// the box the merged vertex keeps the coordinate of `stays` exactly.
LeastCost least_cost(const EdgeEnds& edge);

/// The cost of a given place.
double cost_at(const EdgeEnds& edge, Vec3 position);

/// Both quadrics together, relative to `origin`.
Quadric merged_quadric(const EdgeEnds& edge, Vec3 origin);

}  // namespace regionmesh
