// Would the faces of the merged vertex come too close to any other face? (P tests 2 and 6: `pinch`, `intersect`)
#pragma once

#include <array>
#include <span>
#include <vector>

#include "judge/verdict/pinch.h"
#include "judge/verdict/rising_faces.h"
#include "judge/verdict/star_planes.h"
#include "judge/verdict/vertex_numbers.h"
#include "mesh/face_tree.h"
#include "regionmesh/promises.h"

namespace regionmesh {

/// Holds the scratch space of the test. Exact: no epsilon decides, cheap tests only rule out.
class IntersectTest {
public:
    /// Looks at all faces round the star. Requires that fold, quality and pinch accepted the star with this position.
    ///   pinch      a new face comes closer than 5 degrees to a face beyond the link edge that both have, or has swept
    ///              over it.
    ///   intersect  a new face would meet another, new or old, other than in shared vertices and edges, or the star
    ///              would sweep over a separate part of the surface.
    /// `gone` are faces in the tree that the change removes, and that the star does not have.
    /// `rising` is null unless the faces bound regions: the first label of each face lies behind it, the second in
    /// front of it.
    ///
    /// With `rising`, faces of the star's interface are skipped if they and the whole star, before and after the
    /// collapse, rise along a common direction, and no vertex moves on a side of the box. A line in that direction
    /// passes from region A to region B wherever it crosses the star or a skipped face. Between two such crossings it
    /// passes back, through a face that is not skipped. Projected along the direction, the old and the new star cover
    /// the same polygon once. If no other face meets the new star or lies in the swept space, a line crosses no other
    /// face between the old and the new star, and so no skipped face. This includes faces that are joined to the star,
    /// which without `rising` need not be outside the swept space. A skipped face makes more than 5 degrees with a face
    /// of the star at an edge (kLeastRise).
    Verdict verdict(const Mesh& mesh, const FaceTree& tree, const RisingFaces* rising, const EdgeStar& star,
                    Vec3 position, const ShapeBounds& bounds, std::span<const FaceId> gone = {});

private:
    /// A vertex near the star.
    struct Place {
        VertexId vertex;
        Sides sides;
        std::uint32_t as_a, as_b;   // new faces that have it, in the one place or the other
        std::uint32_t is_shared;    // 1 for a vertex of the new star
        std::uint32_t is_of_star;   // 1 where all faces that have it are of the star
        std::uint32_t is_in_reach;  // 1 in the box of all that is swept
    };
    /// A face outside the star.
    using Corners = std::array<const Place*, 3>;

    bool is_simple_disk(const EdgeStar& star) const;
    bool meets_itself(const EdgeStar& star);
    bool meet_in_star(const EdgeStar& star, int i, int j) const;
    void prepare(const Mesh& mesh, const EdgeStar& star, int first);
    Place& place_of(VertexId v) { return places_[numbers_.of(v)]; }
    void number_vertices();
    void find_sides(const Mesh& mesh);
    Corners corners_of(std::size_t face) const {
        return {&places_[corners_[3 * face]], &places_[corners_[3 * face + 1]], &places_[corners_[3 * face + 2]]};
    }
    std::span<const std::uint32_t> without(std::span<const FaceId> gone, std::span<const std::uint32_t> faces);
    std::span<const std::uint32_t> without_rising(const Mesh& mesh, const RisingFaces& rising, const EdgeStar& star,
                                                  std::span<const std::uint32_t> faces, Directions& common);
    void find_near(const Mesh& mesh, const EdgeStar& star, std::span<const std::uint32_t> faces);
    bool may_meet(const EdgeStar& star, const Corners& old) const;
    Verdict look_at(const Mesh& mesh, const EdgeStar& star, const ShapeBounds& bounds, const Corners& old) const;
    /// 1 where the star sweeps near all corners, and where it matters: the face is not joined to the star, or others
    /// are skipped.
    std::uint32_t may_be_swept(const Corners& old, std::uint32_t shared) const {
        return old[0]->is_in_reach & old[1]->is_in_reach & old[2]->is_in_reach & ((shared == 0) | is_skipping_);
    }
    static std::uint32_t faces_at(const Place& from, const Place& to) {
        return (from.as_a & to.as_b) | (from.as_b & to.as_a);
    }
    bool pinches(const Mesh& mesh, const EdgeStar& star, const ShapeBounds& bounds, const Corners& old) const;
    bool meets(const Mesh& mesh, const EdgeStar& star, const Corners& old, std::uint32_t faces) const;
    bool is_swept(const Mesh& mesh, const EdgeStar& star, const Corners& old) const;

    Vec3 position_;
    Box box_;                            // of all that the star sweeps
    std::vector<std::uint32_t> others_;  // faces that are not skipped; room for more
    std::vector<std::uint32_t> left_;    // faces that are not gone
    StarPlanes planes_;
    int first_ = 0;                       // of the new faces under test
    std::uint32_t is_skipping_ = 0;       // 1 where rising faces are skipped
    Sides apex_;                          // of their apexes: the opposite of their certain sides
    VertexNumbers numbers_;               // of the vertices looked up
    std::vector<Place> places_;           // by number
    std::vector<VertexId> vertices_;      // three for each face found,
    std::vector<std::uint32_t> corners_;  // and their numbers
    std::vector<std::uint32_t> near_;     // those that have to be looked at; room for more
    std::size_t near_count_ = 0;
};

}  // namespace regionmesh
