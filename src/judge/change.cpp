#include "judge/change.h"

namespace regionmesh {

bool propose_flip(const Mesh& mesh, const Flip& flip, Change& change) {
    const std::optional<FlipBound> bound = flip_bound(mesh, flip);
    if (!bound) return false;
    change.flip = flip;
    change.gone = {flip.f, flip.g};
    change.flip_error = *bound;
    gather_flip(mesh, flip, change.star);
    return true;
}

void list_faces_before(const Mesh& mesh, const Change& change, std::vector<LabelledTriangle>& faces) {
    const EdgeStar& star = change.star;
    faces.clear();
    if (change.replaces_others()) {
        for (const FaceId f : change.gone) faces.push_back({mesh.corners(f), mesh[f].labels});
        return;
    }
    for (int n = 0; n < star.face_count(); ++n)
        faces.push_back({{star.at_apex(n), star.at_a(n), star.at_b(n)}, mesh[star.faces[n].face].labels});
    for (const FaceId f : star.dead) faces.push_back({mesh.corners(f), mesh[f].labels});
}

void list_faces_after(const Mesh& mesh, const Change& change, std::vector<LabelledTriangle>& faces) {
    const EdgeStar& star = change.star;
    faces.clear();
    for (int n = 0; n < star.face_count(); ++n)
        faces.push_back({{change.position, star.at_a(n), star.at_b(n)}, mesh[star.faces[n].face].labels});
}

}  // namespace regionmesh
