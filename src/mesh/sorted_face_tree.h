// Which faces are near, where faces stay as they are? A tree of boxes that sorts them itself if need be.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "mesh/grid_tree.h"
#include "regionmesh/ids.h"
#include "regionmesh/mesh.h"

namespace regionmesh {

/// A tree of boxes over faces in order of id if that is spatial enough, as it is after Mesh::sort_spatially and strip
/// by strip, else along a Morton curve. 14 bytes a face, and 4 where it has to sort. Made on several threads.
class SortedFaceTree {
public:
    /// Over all faces that are alive.
    SortedFaceTree(const Mesh& mesh, std::uint32_t threads);
    /// Over faces 0 .. face_end - 1, all in `extent`; one whose box is empty is not there.
    SortedFaceTree(std::uint32_t face_end, const Box& extent, const std::function<Box(FaceId)>& box_of,
                   std::uint32_t threads);

    /// Calls visit(FaceId) for every face that meets `box`, and maybe for some more. A visit that returns false ends
    /// the search.
    template <class Visit>
    void search(const Box& box, Visit&& visit) const {
        boxes_.search(box, [&](std::uint32_t place, const GridTree::GridBox&) { return visit(face(place)); });
    }

    std::size_t bytes() const { return boxes_.bytes() + faces_.capacity() * sizeof(FaceId); }
    /// By place: every two faces that meet are among its pairs.
    const GridTree& boxes() const { return boxes_; }
    FaceId face(std::uint32_t place) const { return faces_.empty() ? FaceId{place} : faces_[place]; }

private:
    std::vector<FaceId> faces_;  // by place; where there are none, the place is the id
    GridTree boxes_;
};

}  // namespace regionmesh
