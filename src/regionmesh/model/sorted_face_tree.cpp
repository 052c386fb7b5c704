#include "regionmesh/model/sorted_face_tree.h"

#include "regionmesh/base/parallel_for.h"
#include "regionmesh/base/radix_sort.h"
#include "regionmesh/model/morton_curve.h"

namespace regionmesh {
namespace {

constexpr std::uint32_t kChunk = 1 << 15;

Box box_round(const Model& model, FaceId f) {
    Box box;
    for (Vec3 p : model.corners(f)) box.add(p);
    return box;
}

}  // namespace

SortedFaceTree::SortedFaceTree(const Model& model, std::uint32_t threads) {
    const auto find = [&](std::uint32_t first, std::uint32_t end) {
        Box box;
        for (std::uint32_t v = first; v < end; ++v)
            if (model.is_alive(VertexId{v})) box.add(model.position(VertexId{v}));
        return box;
    };
    for_chunks(model.vertex_end(), kChunk, threads, find, [&](const Box& box) { extent_.add(box); });
    build(model, model.face_end(), threads);
}

SortedFaceTree::SortedFaceTree(const Model& model, std::vector<FaceId> faces, std::uint32_t threads)
    : faces_(std::move(faces)) {
    for (FaceId f : faces_) extent_.add(box_round(model, f));
    build(model, static_cast<std::uint32_t>(faces_.size()), threads);
}

void SortedFaceTree::build(const Model& model, std::uint32_t places, std::uint32_t threads) {
    const auto box_of = [&](std::uint32_t place) {
        return model.is_alive(face(place)) ? box_round(model, face(place)) : Box{};
    };
    boxes_.build(places, extent_, threads, box_of);
    if (boxes_.is_spatial()) return;
    sort(model, places);
    boxes_.build(static_cast<std::uint32_t>(faces_.size()), extent_, threads, box_of);
}

void SortedFaceTree::sort(const Model& model, std::uint32_t places) {
    const MortonCurve curve(extent_);
    std::vector<KeyedIndex> order;
    for (std::uint32_t place = 0; place < places; ++place) {
        if (!model.is_alive(face(place))) continue;
        const Box box = box_round(model, face(place));
        order.push_back({curve(0.5 * (box.low + box.high)), index(face(place))});
    }
    radix_sort(order);
    faces_.clear();
    faces_.reserve(order.size());
    for (const KeyedIndex& item : order) faces_.push_back(FaceId{item.index});
}

}  // namespace regionmesh
