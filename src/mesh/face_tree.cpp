#include "mesh/face_tree.h"

#include "mesh/extent.h"

namespace regionmesh {

void FaceTree::build(std::uint32_t threads, std::uint32_t spare) {
    const std::uint32_t faces = mesh_->face_end() + spare;
    const Box extent = extent_of(*mesh_, threads);
    if (!is_paired_) return boxes_.build(faces, extent, threads, [&](std::uint32_t f) { return box_at(f); });
    boxes_.build(faces / 2 + faces % 2, extent, threads, [&](std::uint32_t pair) {
        Box box = box_at(2 * pair);
        box.join(box_at(2 * pair + 1));
        return box;
    });
}

void FaceTree::set_pair(FaceId f, const GridBox& box) {
    const Box other = box_at(index(f) ^ 1);
    GridBox both = box;
    if (!other.is_empty()) both.join(boxes_.outward(other));
    boxes_.set(index(f) / 2, both);
}

void FaceTree::remove_of_pair(FaceId f) {
    const Box other = box_at(index(f) ^ 1);
    if (other.is_empty())
        boxes_.remove(index(f) / 2);
    else
        boxes_.set(index(f) / 2, boxes_.outward(other));
}

std::array<FaceTree::GridBox, 2> FaceTree::boxes_of(const Lanes3<Double2>& a, const Lanes3<Double2>& b,
                                                    const Lanes3<Double2>& c) const {
    const auto low = [](Double2 p, Double2 q, Double2 r) { return least(least(p, q), r); };
    const auto high = [](Double2 p, Double2 q, Double2 r) { return greatest(greatest(p, q), r); };
    return boxes_.outward({low(a.x, b.x, c.x), low(a.y, b.y, c.y), low(a.z, b.z, c.z)},
                          {high(a.x, b.x, c.x), high(a.y, b.y, c.y), high(a.z, b.z, c.z)});
}

}  // namespace regionmesh
