#include "regionmesh/model/face_tree.h"

namespace regionmesh {

void FaceTree::build(const Model& model) {
    Box extent;
    for (std::uint32_t v = 0; v < model.vertex_end(); ++v)
        if (model.is_alive(VertexId{v})) extent.add(model.position(VertexId{v}));
    boxes_.build(model.face_end(), extent, 1, [&](std::uint32_t n) {
        Box box;
        if (!model.is_alive(FaceId{n})) return box;
        for (Vec3 p : model.corners(FaceId{n})) box.add(p);
        return box;
    });
}

}  // namespace regionmesh
