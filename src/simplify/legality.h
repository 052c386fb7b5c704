// May this edge be collapsed? The tests (docs/decimate.md) that need only the star of the edge and its neighbours.
#pragma once

#include "regionmesh/verdict.h"
#include "simplify/edge_star.h"

namespace regionmesh {

/// Bounds of the shape tests.
struct ShapeBounds {
    double min_quality = 0.1;                          // of modified faces; a star with faces below may keep as many
    double min_turn_cosine = 0.2;                      // between the normals of a face before and after
    double min_dihedral_cosine = 0.99619469809174555;  // cosine of 5 degrees: faces at an edge are not closer
};

/// Strata and link: whether the topology of the region complex stays as it is.
///   strata  the edge's label set equals that of the vertex that goes (P tests 3 and 4).
///   link    Lk(goes) and Lk(stays) meet in exactly Lk(edge), in the complex and in the network of lines (Dey et al.
///           1999; Vivodtzev et al. 2005); implies that the Euler characteristics stay (P test 5). And no edge
///           comes to lie on an edge of the box that was beside it.
Verdict topology_verdict(const Mesh& mesh, const EdgeStar& star);

/// The same for an edge whose end `stays` does not move (gather_half). Requires that the edge is of the stratum of
/// `goes`.
Verdict half_topology_verdict(const Mesh& mesh, const EdgeStar& star);

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

/// The least quality, to the third power, of the faces that a vertex leaves when it goes to a neighbour; 0 when a face
/// folds or gets below the bound. `around` is that of gather_vertex.
double fan_quality3(const EdgeStar& around, VertexId target, Vec3 at_target, const ShapeBounds& bounds);

/// Pinch at an edge of the link (P test 2): does new face n of the star come closer than 5 degrees to a face beyond the
/// edge that it keeps, or pass through its place? `third` is the corner of the face beyond; `runs_back` tells whether
/// that face passes the edge from b to a. Requires the normals of shape_verdict.
bool pinches_beyond(const EdgeStar& star, int n, Vec3 position, Vec3 third, bool runs_back, const ShapeBounds& bounds);

/// A face that keeps the vertex `stays` of a star that does (gather_half), on an edge from there to the link: the way
/// it passes the edge, and its third corner.
struct KeptFace {
    bool leads_to_stays;
    Vec3 third;
    bool is_on_line;  // three or more faces may be at the edge
};

/// Pinch at an edge from `stays` that a face beside the star has: does new face n come closer than 5 degrees to that
/// face, or has it taken a place beyond it? `at_a` tells which of its corners the other end of the edge is.
bool pinches_beside(const EdgeStar& star, int n, bool at_a, const KeptFace& kept, const ShapeBounds& bounds);

/// Both for all edges that the star shares with its surroundings, looked up in the model.
bool pinches_around(const Mesh& mesh, const EdgeStar& star, Vec3 position, const ShapeBounds& bounds);

}  // namespace regionmesh
