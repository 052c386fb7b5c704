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

std::array<FaceTree::GridBox, 2> FaceTree::boxes_of(const Lanes3<Double2>& a, const Lanes3<Double2>& b,
                                                    const Lanes3<Double2>& c) const {
    const auto low = [](Double2 p, Double2 q, Double2 r) { return least(least(p, q), r); };
    const auto high = [](Double2 p, Double2 q, Double2 r) { return greatest(greatest(p, q), r); };
    return boxes_.outward({low(a.x, b.x, c.x), low(a.y, b.y, c.y), low(a.z, b.z, c.z)},
                          {high(a.x, b.x, c.x), high(a.y, b.y, c.y), high(a.z, b.z, c.z)});
}

}  // namespace regionmesh
