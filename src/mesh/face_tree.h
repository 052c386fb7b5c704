// A bounding volume hierarchy over faces that move and grow.
#pragma once

#include <cstdint>
#include <span>

#include "mesh/grid_tree.h"
#include "regionmesh/mesh.h"
#include "regionmesh/vec3.h"

namespace regionmesh {

/// A tree of boxes over the faces in order of id, which should be a spatial order (Mesh::sort_spatially).
class FaceTree {
public:
    using GridBox = GridTree::GridBox;

    explicit FaceTree(const Mesh& mesh, std::uint32_t threads = 1) { build(mesh, threads); }

    /// Rebuilds the tree from the living faces, on at most `threads` threads (0: one per core); releases the old boxes
    /// first.
    void build(const Mesh& mesh, std::uint32_t threads = 1);

    /// Moves face f to `box`. The boxes above it grow and never shrink.
    void set(FaceId f, const Box& box) { set(f, boxes_.outward(box)); }
    void set(FaceId f, const GridBox& box) { boxes_.set(index(f), box); }
    /// The boxes of two triangles side by side.
    std::array<GridBox, 2> boxes_of(const Lanes3<Double2>& a, const Lanes3<Double2>& b, const Lanes3<Double2>& c) const;
    /// Removes face f.
    void remove(FaceId f) { boxes_.remove(index(f)); }

    /// Calls visit(span of the numbers of faces) until all faces in the tree whose rounded box meets `box` have been
    /// visited, with at most GridTree::kMostAtOnce at once. A visit that returns false ends the search.
    template <class Visit>
    void search(const Box& box, Visit&& visit) const {
        boxes_.search(box, visit);
    }

    std::size_t bytes() const { return boxes_.bytes(); }

private:
    GridTree boxes_;
};

}  // namespace regionmesh
