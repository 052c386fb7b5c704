// Which faces are near, where faces stay as they are? A tree of boxes that sorts them itself if need be.
#pragma once

#include <cstdint>
#include <vector>

#include "regionmesh/base/ids.h"
#include "regionmesh/model/box_tree.h"
#include "regionmesh/model/model.h"

namespace regionmesh {

/// A tree of boxes over the faces of a model or some of them. In order of id if that is spatial enough, as it is after
/// Model::sort_spatially and strip by strip, else along a Morton curve. 14 bytes a face, and 4 where not all in order.
class SortedFaceTree {
public:
    /// Over all faces that are alive.
    SortedFaceTree(const Model& model, std::uint32_t threads);
    /// Over these, which are alive.
    SortedFaceTree(const Model& model, std::vector<FaceId> faces, std::uint32_t threads);

    /// Calls visit(FaceId) for every face that meets `box`, and maybe for some more. A visit that returns false ends
    /// the search.
    template <class Visit>
    void search(const Box& box, Visit&& visit) const {
        boxes_.search(box, [&](std::uint32_t place, const BoxTree::GridBox&) { return visit(face(place)); });
    }

    /// By place: every two faces that meet are among its pairs.
    const BoxTree& boxes() const { return boxes_; }
    FaceId face(std::uint32_t place) const { return faces_.empty() ? FaceId{place} : faces_[place]; }

private:
    void build(const Model& model, std::uint32_t places, std::uint32_t threads);
    void sort(const Model& model, std::uint32_t places);

    Box extent_;
    std::vector<FaceId> faces_;  // by place; where there are none, the place is the id
    BoxTree boxes_;
};

}  // namespace regionmesh
