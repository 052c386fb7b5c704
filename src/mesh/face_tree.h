// A bounding volume hierarchy over faces that move and grow.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "base/box.h"
#include "mesh/extent.h"
#include "mesh/grid_tree.h"
#include "regionmesh/mesh.h"
#include "regionmesh/vec3.h"

namespace regionmesh {

/// A tree of boxes over the faces in order of id, which should be a spatial order (Mesh::sort_spatially). A box holds
/// one face (14 bytes a face) or two with consecutive ids (7 bytes a face); in pairs, a search compares the box of each
/// of the two faces, which it reads from the mesh. The mesh must outlive the tree.
class FaceTree {
public:
    using GridBox = GridTree::GridBox;
    enum class Faces : std::uint8_t { kOneByOne, kInPairs };

    /// Runs on at most `threads` threads (0: one per core).
    explicit FaceTree(const Mesh& mesh, std::uint32_t threads = 1, Faces faces = Faces::kOneByOne)
        : mesh_(&mesh), is_paired_(faces == Faces::kInPairs) {
        build(threads);
    }

    /// Rebuilds the tree from the living faces, with room for `spare` more; releases the old boxes first.
    void build(std::uint32_t threads = 1, std::uint32_t spare = 0);

    /// Moves face f to `box`. In pairs, reads the position of the other face from the mesh. The boxes above it grow and
    /// never shrink.
    void set(FaceId f, const Box& box) { set(f, boxes_.outward(box)); }
    void set(FaceId f, const GridBox& box) {
        if (is_paired_)
            set_pair(f, box);
        else
            boxes_.set(index(f), box);
    }
    /// The boxes of two triangles side by side.
    std::array<GridBox, 2> boxes_of(const Lanes3<Double2>& a, const Lanes3<Double2>& b, const Lanes3<Double2>& c) const;
    /// Removes face f. In pairs, requires that the mesh has removed it, too.
    void remove(FaceId f) {
        if (is_paired_)
            remove_of_pair(f);
        else
            boxes_.remove(index(f));
    }

    static constexpr std::uint32_t kMostAtOnce = 2 * GridTree::kMostAtOnce;
    /// Calls visit(span of the numbers of faces) until all faces in the tree whose rounded box meets `box` have been
    /// visited, with at most kMostAtOnce at once. A visit that returns false ends the search.
    template <class Visit>
    void search(const Box& box, Visit&& visit) const {
        if (is_paired_)
            search_pairs(box, visit);
        else
            boxes_.search(box, visit);
    }

    std::size_t bytes() const { return boxes_.bytes(); }

private:
    /// Empty if the mesh has no such face, as beside the last face of an odd number.
    Box box_at(std::uint32_t f) const { return f < mesh_->face_end() ? box_of(*mesh_, FaceId{f}) : Box(); }
    void set_pair(FaceId f, const GridBox& box);
    void remove_of_pair(FaceId f);
    template <class Visit>
    void search_pairs(const Box& box, Visit& visit) const;

    const Mesh* mesh_;
    bool is_paired_;
    GridTree boxes_;
};

template <class Visit>
void FaceTree::search_pairs(const Box& box, Visit& visit) const {
    std::array<std::uint32_t, kMostAtOnce> faces;
    boxes_.search(box, [&](std::span<const std::uint32_t> pairs) {
        std::size_t count = 0;
        for (const std::uint32_t pair : pairs) __builtin_prefetch(&(*mesh_)[FaceId{2 * pair}]);
        for (const std::uint32_t pair : pairs)
            for (const std::uint32_t f : {2 * pair, 2 * pair + 1}) {
                faces[count] = f;
                count += overlap(box_at(f), box);
            }
        return visit(std::span<const std::uint32_t>(faces.data(), count));
    });
}

}  // namespace regionmesh
