#include "regionmesh/decimate/edge_star.h"

#include <algorithm>

#include "regionmesh/base/triangle.h"

namespace regionmesh {
namespace {

void add_surviving(const Model& model, FaceId f, int place, EdgeStar& star) {
    const Face& face = model[f];
    StarFace kept;
    kept.face = f;
    kept.apex = face.vertices[place];
    kept.a = face.vertices[(place + 1) % 3];
    kept.b = face.vertices[(place + 2) % 3];
    kept.at_a = model.position(kept.a);
    kept.at_b = model.position(kept.b);
    kept.old_normal = area_vector(model.position(kept.apex), kept.at_a, kept.at_b);
    kept.old_length = length(kept.old_normal);
    star.faces.push_back(kept);
}

}  // namespace

void gather(const Model& model, VertexId goes, VertexId stays, EdgeStar& star) {
    star.goes = goes;
    star.stays = stays;
    star.faces.clear();
    star.dead.clear();
    star.apexes.clear();
    star.link.clear();
    model.for_star(goes, [&](FaceId f, int place) {
        const Face& face = model[f];
        const VertexId a = face.vertices[(place + 1) % 3], b = face.vertices[(place + 2) % 3];
        if (a != stays && b != stays) return add_surviving(model, f, place, star);
        star.dead.push_back(f);
        star.apexes.push_back(a == stays ? b : a);
    });
    model.for_star(stays, [&](FaceId f, int place) {
        const Face& face = model[f];
        if (face.vertices[(place + 1) % 3] != goes && face.vertices[(place + 2) % 3] != goes)
            add_surviving(model, f, place, star);
    });
    for (const StarFace& face : star.faces)
        for (VertexId v : {face.a, face.b})
            if (std::find(star.link.begin(), star.link.end(), v) == star.link.end()) star.link.push_back(v);
}

}  // namespace regionmesh
