// A bounding volume hierarchy over faces that do not change. Sorts them itself if necessary.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "mesh/grid_tree.h"
#include "regionmesh/ids.h"
#include "regionmesh/mesh.h"

namespace regionmesh {

/// A tree of boxes over faces in order of id if that order is spatial enough, as after Mesh::sort_spatially or strip by
/// strip; otherwise along a Morton curve. 14 bytes per face, or 18 if it has to sort. Built on several threads.
class SortedFaceTree {
public:
    /// Contains all living faces.
    SortedFaceTree(const Mesh& mesh, std::uint32_t threads);
    /// Contains faces 0 .. face_end - 1, all within `extent`, except those with an empty box.
    SortedFaceTree(std::uint32_t face_end, const Box& extent, const std::function<Box(FaceId)>& box_of,
                   std::uint32_t threads);

    /// Calls visit(FaceId) for every face that meets `box`, and possibly for others. A visit that returns false ends
    /// the search.
    template <class Visit>
    void search(const Box& box, Visit&& visit) const {
        boxes_.search(box, [&](std::span<const std::uint32_t> items) {
            return std::all_of(items.begin(), items.end(), [&](std::uint32_t item) { return visit(face(item)); });
        });
    }

    std::size_t bytes() const { return boxes_.bytes() + faces_.capacity() * sizeof(FaceId); }
    /// Tree over indices in the sorted order: its pairs include every two faces that meet.
    const GridTree& boxes() const { return boxes_; }
    FaceId face(std::uint32_t item) const { return faces_.empty() ? FaceId{item} : faces_[item]; }

private:
    template <class BoxOf>
    void build(std::uint32_t face_end, const Box& extent, const BoxOf& box_of, std::uint32_t threads);

    std::vector<FaceId> faces_;  // face of each index; empty if indices are ids
    GridTree boxes_;
};

}  // namespace regionmesh
