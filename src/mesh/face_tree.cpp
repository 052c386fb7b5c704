#include "mesh/face_tree.h"

#include "mesh/extent.h"

namespace regionmesh {

void FaceTree::build(const Mesh& mesh, std::uint32_t threads) {
    boxes_.build(mesh.face_end(), extent_of(mesh, threads), threads, [&](std::uint32_t f) {
        Box box;
        if (!mesh.is_alive(FaceId{f})) return box;
        for (Vec3 p : mesh.corners(FaceId{f})) box.add(p);
        return box;
    });
}

}  // namespace regionmesh
