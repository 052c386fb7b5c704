// Would the faces of the merged vertex come too close to any other face? (P tests 2 and 6: `pinch`, `intersect`)
#pragma once

#include <array>
#include <vector>

#include "mesh/face_tree.h"
#include "regionmesh/verdict.h"
#include "simplify/verdict/pinch.h"
#include "simplify/verdict/star_planes.h"

namespace regionmesh {

/// Holds the scratch space of the test. Exact: no epsilon decides, cheap tests only rule out.
class IntersectTest {
public:
    /// Looks at all faces round the star. Requires that fold, quality and pinch accepted the star with this position.
    ///   pinch      a new face comes closer than 5 degrees to a face beyond the link edge that both have, or has swept
    ///              over it.
    ///   intersect  a new face would meet another, new or old, other than in shared vertices and edges, or the star
    ///              would sweep over a separate part of the surface.
    Verdict verdict(const Mesh& mesh, const FaceTree& tree, const EdgeStar& star, Vec3 position,
                    const ShapeBounds& bounds);

private:
    /// A vertex near the star, looked up once.
    struct Place {
        std::uint64_t key = 0;  // search and vertex
        Sides sides;
        std::uint32_t as_a, as_b;   // new faces that have it, in the one place or the other
        std::uint32_t is_shared;    // 1 for a vertex of the new star
        std::uint32_t is_of_star;   // 1 where all faces that have it are of the star
        std::uint32_t is_in_reach;  // 1 in the box of all that is swept

        VertexId vertex() const { return VertexId{static_cast<std::uint32_t>(key)}; }
    };
    /// A face outside the star.
    using Corners = std::array<const Place*, 3>;

    static constexpr std::uint32_t kPlaces = 256;  // a power of two; used to three quarters

    bool is_simple_disk(const EdgeStar& star) const;
    bool meets_itself(const Mesh& mesh, const EdgeStar& star);
    bool meet_in_star(const EdgeStar& star, int i, int j) const;
    void prepare(const Mesh& mesh, const EdgeStar& star, int first);
    static std::uint32_t hash(VertexId v) { return index(v) * 0x9E3779B1u >> 24; }
    std::uint64_t key_of(VertexId v) const { return std::uint64_t{search_} << 32 | index(v); }
    Place& place_of(const Mesh& mesh, VertexId v, int corner) {
        Place& place = table_[hash(v)];
        return place.key == key_of(v) ? place : find_place(mesh, v, corner);
    }
    Place& find_place(const Mesh& mesh, VertexId v, int corner);
    Verdict look_at(const Mesh& mesh, const EdgeStar& star, const ShapeBounds& bounds, FaceId f);
    static std::uint32_t faces_at(const Place& from, const Place& to) {
        return (from.as_a & to.as_b) | (from.as_b & to.as_a);
    }
    bool pinches(const Mesh& mesh, const EdgeStar& star, const ShapeBounds& bounds, const Corners& old) const;
    bool meets(const Mesh& mesh, const EdgeStar& star, const Corners& old, std::uint32_t faces) const;
    bool is_swept(const Mesh& mesh, const EdgeStar& star, const Corners& old) const;

    Vec3 position_;
    Box box_;  // of all that the star sweeps
    StarPlanes planes_;
    int first_ = 0;                                           // of the new faces under test
    Sides apex_;                                              // of their apexes: the opposite of their certain sides
    std::vector<Place> table_ = std::vector<Place>(kPlaces);  // by vertex, hashed
    std::uint32_t search_ = 0, used_ = 0;
    std::array<Place, 3> spare_;  // for the corners of a face when the table is full
};

}  // namespace regionmesh
