// Which faces are near? A tree of boxes that follows the faces as they move and grow.
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

    explicit FaceTree(const Mesh& mesh) { build(mesh); }

    /// Begins again with the faces that are alive now; the old boxes are let go first.
    void build(const Mesh& mesh);

    /// Face f now lies in `box`. The boxes above it grow, and never shrink.
    void set(FaceId f, const Box& box) { boxes_.set(index(f), box); }
    /// Face f is gone.
    void remove(FaceId f) { boxes_.remove(index(f)); }

    /// Calls visit(FaceId, GridBox) for every face in the tree whose rounded box, which is given, meets `box`. A visit
    /// that returns false ends the search.
    template <class Visit>
    void search(const Box& box, Visit&& visit) const {
        boxes_.search(box, [&](std::uint32_t f, const GridBox& found) { return visit(FaceId{f}, found); });
    }

    std::size_t bytes() const { return boxes_.bytes(); }

private:
    GridTree boxes_;
};

}  // namespace regionmesh
