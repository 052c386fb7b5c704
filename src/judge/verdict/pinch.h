// Do faces of the new star come too close to neighbouring faces? (P test 2)
#pragma once

#include <span>

#include "judge/edge_star.h"
#include "judge/verdict/shape_bounds.h"

namespace regionmesh {

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

/// Pinch at an edge from `stays` that a face outside the star has: does new face n come closer than 5 degrees to that
/// face, or has it taken a place beyond it? `at_a` tells which of its corners the other end of the edge is.
bool pinches_beside(const EdgeStar& star, int n, bool at_a, const KeptFace& kept, const ShapeBounds& bounds);

/// Both for all edges that the star shares with its surroundings, looked up in the mesh, but for the faces in `gone`.
bool pinches_around(const Mesh& mesh, const EdgeStar& star, Vec3 position, const ShapeBounds& bounds,
                    std::span<const FaceId> gone = {});

}  // namespace regionmesh
