// Faces that meet outside what they share, exactly (P test 6, over the whole model).
#include "regionmesh/check/findings.h"
#include "regionmesh/model/exact_predicates.h"
#include "regionmesh/model/face_meeting.h"
#include "regionmesh/model/face_tree.h"

namespace regionmesh {

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
            if (meet_outside_shared({model[f].vertices, p}, {model[g].vertices, q}))
                findings.add(ViolationKind::kCrossingFaces, {}, {index(f), index(g)},
                             "faces " + std::to_string(n) + " and " + std::to_string(index(g)) + " cross");
            return true;
        });
    }
}

}  // namespace regionmesh
