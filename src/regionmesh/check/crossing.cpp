// Faces that meet outside what they share, exactly (P test 6, over the whole model).
#include <algorithm>

#include "regionmesh/check/findings.h"
#include "regionmesh/model/exact_predicates.h"
#include "regionmesh/model/face_tree.h"

namespace regionmesh {
namespace {

bool boxes_overlap(const std::array<Vec3, 3>& p, const std::array<Vec3, 3>& q) {
    for (int axis = 0; axis < 3; ++axis) {
        if (std::min({p[0][axis], p[1][axis], p[2][axis]}) > std::max({q[0][axis], q[1][axis], q[2][axis]}))
            return false;
        if (std::max({p[0][axis], p[1][axis], p[2][axis]}) < std::min({q[0][axis], q[1][axis], q[2][axis]}))
            return false;
    }
    return true;
}

bool do_cross(const Model& model, FaceId f, FaceId g) {
    const auto p = model.corners(f), q = model.corners(g);
    if (!boxes_overlap(p, q)) return false;
    std::array<int, 3> at{-1, -1, -1};  // where each corner of f is in g
    int shared = 0, own = -1, common = -1;
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j)
            if (model[f].vertices[i] == model[g].vertices[j]) at[i] = j;
        if (at[i] >= 0) {
            ++shared;
            common = i;
        } else {
            own = i;
        }
    }
    if (shared == 0) return meet({p[0], p[1], p[2]}, {q[0], q[1], q[2]});
    if (shared == 1)
        return meet_beyond_vertex(p[common], p[(common + 1) % 3], p[(common + 2) % 3], q[(at[common] + 1) % 3],
                                  q[(at[common] + 2) % 3]);
    if (shared == 2) {
        const int a = (own + 1) % 3, b = (own + 2) % 3;
        return meet_beyond_edge(p[a], p[b], p[own], q[3 - at[a] - at[b]]);
    }
    return true;
}

}  // namespace

void check_crossing(const Model& model, Findings& findings) {
    const FaceTree tree(model);
    for (std::uint32_t n = 0; n < model.face_end(); ++n) {
        const FaceId f{n};
        if (!model.is_alive(f)) continue;
        const auto p = model.corners(f);
        if (is_degenerate({p[0], p[1], p[2]})) continue;  // named already
        Box box;
        for (Vec3 corner : p) box.add(corner);
        tree.search(box, [&](FaceId g, const FaceTree::GridBox&) {
            if (g <= f || !boxes_overlap(p, model.corners(g))) return true;
            const auto q = model.corners(g);
            if (is_degenerate({q[0], q[1], q[2]})) return true;
            if (do_cross(model, f, g))
                findings.add(ViolationKind::kCrossingFaces, {}, {index(f), index(g)},
                             "faces " + std::to_string(n) + " and " + std::to_string(index(g)) + " cross");
            return true;
        });
    }
}

}  // namespace regionmesh
