// Which faces are near? A tree of boxes that follows the faces as they move and grow.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "regionmesh/base/vec3.h"
#include "regionmesh/model/model.h"

namespace regionmesh {

/// An eight-fold tree of boxes over the faces in order of id, which should be a spatial order (Model::sort_spatially).
/// Boxes are rounded outward to 1/65535 of the model's extent, two bytes a coordinate, so that eight of them are
/// compared at once: 14 bytes a face all told.
class FaceTree {
public:
    static constexpr std::uint32_t kFan = 8;

    /// A box in cells of the grid.
    struct GridBox {
        std::int16_t low[3];
        std::int16_t high[3];
    };
    /// Eight boxes side by side.
    struct alignas(16) Boxes {
        std::int16_t low[3][kFan];
        std::int16_t high[3][kFan];

        /// Boxes that meet nothing.
        static Boxes none();
        GridBox operator[](std::uint32_t lane) const;
        void put(std::uint32_t lane, const GridBox& box);
        /// Bit n is set when box n meets `box`.
        unsigned meeting(const GridBox& box) const;
    };

    explicit FaceTree(const Model& model) { build(model); }
    /// Over the boxes given, for faces numbered as they are.
    explicit FaceTree(std::span<const Box> boxes);

    /// Begins again with the faces that are alive now; the old boxes are let go first.
    void build(const Model& model);

    /// The smallest box of the grid round `box`, and a little more.
    GridBox outward(const Box& box) const;

    /// Face f now lies in `box`. The boxes above it grow, and never shrink.
    void set(FaceId f, const Box& box);
    /// Face f is gone.
    void remove(FaceId f);

    /// Calls visit(FaceId, GridBox) for every face in the tree whose rounded box, which is given, meets `box`. A visit
    /// that returns false ends the search.
    template <class Visit>
    void search(const Box& box, Visit&& visit) const;

    std::size_t bytes() const;

private:
    void begin(std::uint32_t face_end, const Box& bounds);
    static bool extend(Boxes& boxes, std::uint32_t lane, const GridBox& box);

    Vec3 origin_;
    double cells_per_length_ = 1;
    std::vector<std::vector<Boxes>> levels_;  // levels_[0][g] holds the boxes of faces 8 g .. 8 g + 7
};

template <class Visit>
void FaceTree::search(const Box& box, Visit&& visit) const {
    const GridBox wanted = outward(box);
    struct Entry {
        std::uint32_t level, group;
    };
    Entry stack[128];
    int top = 0;
    stack[top++] = {static_cast<std::uint32_t>(levels_.size()) - 1, 0};
    while (top > 0) {
        const Entry entry = stack[--top];
        const Boxes& boxes = levels_[entry.level][entry.group];
        for (unsigned mask = boxes.meeting(wanted); mask; mask &= mask - 1) {
            const std::uint32_t lane = static_cast<std::uint32_t>(__builtin_ctz(mask)),
                                child = entry.group * kFan + lane;
            if (entry.level > 0)
                stack[top++] = {entry.level - 1, child};
            else if (!visit(FaceId{child}, boxes[lane]))
                return;
        }
    }
}

}  // namespace regionmesh
