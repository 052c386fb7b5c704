// May this edge be collapsed? The tests of DESIGN 6 that need only the star of the edge and its neighbours.
#pragma once

#include "regionmesh/decimate/edge_star.h"
#include "regionmesh/decimate/verdict.h"

namespace regionmesh {

/// Bounds of the shape tests.
struct ShapeBounds {
    double min_quality = 0.1;                          // of modified faces; a face that was below may only get better
    double min_turn_cosine = 0.2;                      // between the normals of a face before and after
    double min_dihedral_cosine = 0.99619469809174555;  // cosine of 5 degrees: faces at an edge are not closer
};

/// Strata and link: whether the topology of the region complex stays as it is.
///   strata  the edge's label set equals that of the vertex that goes (P tests 3 and 4).
///   link    Lk(goes) and Lk(stays) meet in exactly Lk(edge), in the complex and in the network of lines (Dey et al.
///           1999; Vivodtzev et al. 2005); implies that the Euler characteristics stay (P test 5). And no edge
///           comes to lie on an edge of the box that was beside it.
Verdict topology_verdict(const Model& model, const EdgeStar& star);

struct ShapeResult {
    Verdict verdict;
    double worst_quality3;  // third power of the least quality of a modified face; of use when accepted
};

/// Fold, quality and pinch within the star, with the merged vertex at `position` (P tests 1, 2; quality test 1). Sets
/// the normals, too.
///   fold     no face turns by more than the bound.
///   quality  no face gets below the bound.
///   pinch    no two faces at an edge from the merged vertex come closer than 5 degrees.
ShapeResult shape_verdict(EdgeStar& star, Vec3 position, const ShapeBounds& bounds);

/// Pinch at an edge of the link (P test 2): does new face n of the star come closer than 5 degrees to a face beyond the
/// edge that it keeps, or pass through its place? `third` is the corner of the face beyond; `runs_back` tells whether
/// that face passes the edge from b to a. Requires the normals of shape_verdict.
bool pinches_beyond(const EdgeStar& star, int n, Vec3 position, Vec3 third, bool runs_back, const ShapeBounds& bounds);

/// The same for all edges of the link, looked up in the model.
bool pinches_at_link(const Model& model, const EdgeStar& star, Vec3 position, const ShapeBounds& bounds);

}  // namespace regionmesh
