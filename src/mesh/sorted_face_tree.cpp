#include "mesh/sorted_face_tree.h"

#include "base/radix_sort.h"
#include "mesh/extent.h"
#include "mesh/morton_curve.h"

namespace regionmesh {
namespace {

template <class BoxOf>
std::vector<FaceId> along_curve(std::uint32_t face_end, const BoxOf& box_of, const Box& extent, std::uint32_t threads) {
    const MortonCurve curve(extent);
    std::vector<KeyedIndex> order;
    for (std::uint32_t f = 0; f < face_end; ++f) {
        const Box box = box_of(FaceId{f});
        if (!box.is_empty()) order.push_back({curve(0.5 * (box.low + box.high)), f});
    }
    radix_sort(order, threads);
    std::vector<FaceId> faces;
    faces.reserve(order.size());
    for (const KeyedIndex& item : order) faces.push_back(FaceId{item.index});
    return faces;
}

}  // namespace

SortedFaceTree::SortedFaceTree(const Mesh& mesh, std::uint32_t threads) {
    build(
        mesh.face_end(), extent_of(mesh, threads), [&](FaceId f) { return box_of(mesh, f); }, threads);
}

SortedFaceTree::SortedFaceTree(std::uint32_t face_end, const Box& extent, const std::function<Box(FaceId)>& box_of,
                               std::uint32_t threads) {
    build(face_end, extent, box_of, threads);
}

template <class BoxOf>
void SortedFaceTree::build(std::uint32_t face_end, const Box& extent, const BoxOf& box_of, std::uint32_t threads) {
    boxes_.build(face_end, extent, threads, [&](std::uint32_t n) { return box_of(FaceId{n}); });
    if (boxes_.is_spatial()) return;
    boxes_ = GridTree();
    faces_ = along_curve(face_end, box_of, extent, threads);
    boxes_.build(static_cast<std::uint32_t>(faces_.size()), extent, threads,
                 [&](std::uint32_t n) { return box_of(faces_[n]); });
}

}  // namespace regionmesh
