// One collapse: the model and its tree afterwards.
#pragma once

#include "mesh/face_tree.h"
#include "simplify/edge_star.h"

namespace regionmesh {

/// Collapses the edge whose star is given, and moves `stays` to `position`.
inline void collapse_edge(Mesh& mesh, FaceTree& tree, const EdgeStar& star, Vec3 position) {
    for (FaceId f : star.dead) {
        mesh.remove_face(f);
        tree.remove(f);
    }
    mesh.move_star(star.goes, star.stays);
    mesh[star.stays].position = position;
    for (int n = 0; n < star.face_count(); ++n) {
        Box box;
        for (Vec3 p : {position, star.at_a(n), star.at_b(n)}) box.add(p);
        tree.set(star.faces[n].face, box);
    }
}

}  // namespace regionmesh
