// Everything round an edge that a collapse touches.
#pragma once

#include <vector>

#include "regionmesh/decimate/verdict.h"
#include "regionmesh/model/model.h"

namespace regionmesh {

/// A face of the star that survives the collapse: it keeps the corners a and b, and its third corner moves to the
/// merged vertex. The order (merged vertex, a, b) is that of the face.
struct StarFace {
    FaceId face;
    VertexId a, b;
    VertexId apex;  // which end of the edge the third corner is now
    Vec3 at_a, at_b;
    Vec3 old_normal;  // twice the area vector before
    Vec3 new_normal;  // and after; set by shape_verdict
    double old_length, new_length;
};

/// The star of the edge goes-stays: reused from collapse to collapse, so that nothing is allocated in the long run.
struct EdgeStar {
    VertexId goes, stays;
    std::vector<StarFace> faces;
    std::vector<FaceId> dead;      // faces at the edge, which vanish
    std::vector<VertexId> apexes;  // their third corners
    std::vector<VertexId> link;    // distinct vertices a, b of the surviving faces
};

/// Collects the star. Requires that goes-stays is an edge.
void gather(const Model& model, VertexId goes, VertexId stays, EdgeStar& star);

}  // namespace regionmesh
