// Which faces are near? Boxes over groups of eight, which follow the faces as they grow.
#pragma once

#include <cstdint>
#include <vector>

#include "regionmesh/base/vec3.h"
#include "regionmesh/model/model.h"

namespace regionmesh {

/// An eight-fold tree of boxes over the faces in Morton order of their middles. A face keeps its place for the life of
/// the tree; when a collapse makes it larger, the boxes above it grow. Faces that die just stay unused.
/// Boxes are floats, rounded outward, relative to the low corner of the model: 11.5 bytes a face all told.
class FaceTree {
public:
    explicit FaceTree(const Model& model);

    /// Face f now reaches at most through `box` as well. Requires that f was alive when the tree was built.
    void grow(FaceId f, const Box& box);

    /// Calls visit(FaceId) for every face whose group's box meets `box`: all faces that meet it, and others, dead ones
    /// among them. A visit that returns false ends the search.
    template <class Visit>
    void search(const Box& box, Visit&& visit) const;

    std::size_t bytes() const;

private:
    static constexpr std::uint32_t kFan = 8;

    /// The boxes of eight groups, side by side for four-fold comparison.
    struct Boxes {
        float low[3][kFan];
        float high[3][kFan];
    };
    struct FloatBox {
        float low[3];
        float high[3];
    };

    FloatBox outward(const Box& box) const;
    static unsigned meeting(const Boxes& boxes, const FloatBox& box);
    static bool extend(Boxes& boxes, std::uint32_t lane, const FloatBox& box);
    void sort_faces(const Model& model);

    Vec3 origin_;
    std::vector<std::uint32_t> order_;        // faces in Morton order
    FlatArray<std::uint32_t> place_;          // of each face in order_
    std::vector<std::vector<Boxes>> levels_;  // levels_[0][g] bounds places 64 g .. 64 g + 63, eight to a box
};

template <class Visit>
void FaceTree::search(const Box& box, Visit&& visit) const {
    if (order_.empty()) return;
    const FloatBox wanted = outward(box);
    struct Entry {
        std::uint32_t level, group;
    };
    Entry stack[128];
    int top = 0;
    stack[top++] = {static_cast<std::uint32_t>(levels_.size()) - 1, 0};
    while (top > 0) {
        const Entry entry = stack[--top];
        unsigned mask = meeting(levels_[entry.level][entry.group], wanted);
        for (; mask; mask &= mask - 1) {
            const std::uint32_t child = entry.group * kFan + static_cast<std::uint32_t>(__builtin_ctz(mask));
            if (entry.level > 0) {
                stack[top++] = {entry.level - 1, child};
                continue;
            }
            const std::size_t first = std::size_t{child} * kFan;
            for (std::size_t place = first; place < std::min<std::size_t>(first + kFan, order_.size()); ++place)
                if (!visit(FaceId{order_[place]})) return;
        }
    }
}

}  // namespace regionmesh
