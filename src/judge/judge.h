// One collapse: what its tests look at, and the mesh and its tree afterwards.
#pragma once

#include <optional>

#include "base/box.h"
#include "mesh/face_tree.h"
#include "regionmesh/lattice.h"
#include "judge/collapse_log.h"
#include "judge/edge_star.h"
#include "judge/error_bound.h"
#include "judge/verdict/intersect_test.h"
#include "judge/verdict/rising_faces.h"
#include "judge/verdict/shape_bounds.h"

namespace regionmesh {

/// The box that holds everything.
inline constexpr Box kUnbounded{{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}, {HUGE_VAL, HUGE_VAL, HUGE_VAL}};

/// Where merged vertices may be: samples on the sides of their box keep their regions only while the surface stays in
/// it.
inline Box limits_of(const std::optional<Box>& box, const std::optional<Lattice>& samples) {
    const Box limits = box.value_or(kUnbounded);
    return samples ? common(limits, samples->extent()) : limits;
}

/// Places for the merged vertex; of two, the one that leaves the better worst face is taken.
struct Places {
    Vec3 first;
    std::optional<Vec3> second = {};
};

/// The collapse under test. Reused from one to the next, so that nothing is allocated in the long run.
struct Collapse {
    const Mesh& mesh;
    FaceTree* tree = nullptr;       // of the faces; none: they may cross
    RisingFaces* rising = nullptr;  // of the same faces, where they bound regions
    ShapeBounds bounds;
    Box limits = kUnbounded;           // a merged vertex that moves stays strictly inside, unless on a side of the box
    const Lattice* samples = nullptr;  // whose samples stay in their regions; none: any may change
    double max_error = HUGE_VAL;       // of ErrorBound
    CollapseLog* log = nullptr;        // gets what is made
    EdgeStar star = {};
    Vec3 position = {};         // of the merged vertex
    double worst_quality3 = 0;  // third power of the least quality of a changed face
    IntersectTest intersect = {};
    ErrorBound error = {};
};

/// Sets the boxes of the star's faces, whose apex is at `position` now.
inline void set_boxes(FaceTree& tree, const EdgeStar& star, Vec3 position) {
    for (int n = 0; n < star.face_count(); n += 2) {
        const StarPair& pair = star.pairs[n / 2];
        const auto boxes = tree.boxes_of(both(position), pair.a, pair.b);
        tree.set(star.faces[n].face, boxes[0]);
        if (n + 1 < star.face_count()) tree.set(star.faces[n + 1].face, boxes[1]);
    }
}

/// Makes the move that was accepted (gather_move), of which the error was tested.
inline void move_vertex(Mesh& mesh, Collapse& collapse) {
    collapse.error.apply(mesh, collapse.star.goes);
    mesh[collapse.star.goes].position = collapse.position;
    set_boxes(*collapse.tree, collapse.star, collapse.position);
}

/// Finds the error bound of the merged vertex, where no largest one made test_error find it.
inline void find_error(Collapse& collapse) {
    if (collapse.max_error == HUGE_VAL) collapse.error.merged(collapse.mesh, collapse.star, collapse.position);
}

/// Makes the collapse that was accepted, of which the error is known (find_error): `stays` moves to the position of the
/// merged vertex.
inline void collapse_edge(Mesh& mesh, Collapse& collapse) {
    const EdgeStar& star = collapse.star;
    const Vec3 position = collapse.position;
    if (collapse.log)
        collapse.log->collapses.push_back({.position = position,
                                           .goes = index(star.goes),
                                           .stays = index(star.stays),
                                           .goes_bound = mesh[star.goes].error_bound(),
                                           .stays_bound = mesh[star.stays].error_bound(),
                                           .level = collapse.log->level,
                                           .faces = static_cast<std::uint32_t>(star.dead.size())});
    collapse.error.apply(mesh, star.stays);
    for (FaceId f : star.dead) {
        mesh.remove_face(f);
        if (collapse.tree) collapse.tree->remove(f);
    }
    mesh.move_star(star.goes, star.stays);
    mesh[star.stays].position = position;
    if (collapse.tree) set_boxes(*collapse.tree, star, position);
    if (collapse.rising && !star.is_flat) collapse.rising->set(star, position);
}

}  // namespace regionmesh
