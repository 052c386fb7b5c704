#include "regionmesh/model/face_tree.h"

#include "regionmesh/model/extent.h"

namespace regionmesh {

void FaceTree::build(const Model& model) {
    boxes_.build(model.face_end(), extent_of(model, 1), 1, [&](std::uint32_t f) {
        Box box;
        if (!model.is_alive(FaceId{f})) return box;
        for (Vec3 p : model.corners(FaceId{f})) box.add(p);
        return box;
    });
}

}  // namespace regionmesh
