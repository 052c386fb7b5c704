// Would the merged vertex's faces meet any other face? (P test 6; DESIGN 6, verdict `intersect`)
#pragma once

#include <array>
#include <vector>

#include "regionmesh/decimate/edge_star.h"
#include "regionmesh/model/face_tree.h"

namespace regionmesh {

/// Holds the scratch space of the test. Exact: no epsilon decides, cheap tests only rule out.
class Obstruction {
public:
    /// True when a new face would meet another, new or old, other than in shared vertices and edges, or when the star
    /// would sweep over a separate part of the surface. Requires that fold and pinch have passed with this position.
    bool blocks(const Model& model, const FaceTree& tree, const EdgeStar& star, Vec3 position);

private:
    using Corners = std::array<Vec3, 3>;

    /// A plane through `at`, square to `out`.
    struct Wall {
        Vec3 at, out;
    };
    /// A face of the new star, from the merged vertex to the link edge a-b, with a wall on each edge: the face lies
    /// behind all three. The wall on the link edge may even have the whole star behind it.
    struct NewFace {
        VertexId a, b;
        Corners corners;            // merged vertex, a, b
        std::array<Wall, 3> walls;  // on the edges after the corners of the same places: [1] is the link edge's
        enum { kUnknown, kSupports, kDoesNot } support;
    };
    /// A face outside the star, and what it shares with the link.
    struct OldFace {
        std::array<VertexId, 3> vertices;
        Corners corners;
        int shared = 0;
        std::array<VertexId, 3> shared_vertices;
        Vec3 shared_at;           // one of them
        std::array<Vec3, 3> own;  // the other corners
    };

    void prepare(const Model& model, const FaceTree& tree, const EdgeStar& star, Vec3 position);
    bool is_simple_disk(const Model& model, const EdgeStar& star) const;
    bool meets_itself() const;
    void add_cell(const FaceTree& tree, const Box& box);
    bool is_near(const FaceTree::GridBox& box) const;
    OldFace look_at(const Model& model, FaceId f) const;
    bool is_clear(const OldFace& old);
    bool supports(NewFace& face) const;
    bool is_off_slab(const Corners& p) const;
    bool meets_new_face(const OldFace& old, const FaceTree::GridBox& box) const;
    static bool meets_at_corner(const NewFace& face, int corner, const Corners& p, int place);
    bool is_swept(const Model& model, const EdgeStar& star, Vec3 q, const FaceTree::GridBox& box) const;

    Vec3 position_;
    std::array<Vec3, 2> ends_;   // where the edge is now
    Vec3 normal_;                // sum of the new faces' normals
    double low_ = 0, high_ = 0;  // extent along it, from position_, of all that the star sweeps
    Box box_;                    // of all that the star sweeps
    std::vector<NewFace> faces_;
    // The box of each new face with the tetrahedron it sweeps; then those of the dead faces.
    std::vector<FaceTree::Boxes> cells_;
    std::uint32_t cell_count_ = 0;
    std::vector<VertexId> link_;
    std::vector<Vec3> link_at_;
    std::uint64_t link_bits_ = 0;  // a bit for each link vertex, by id modulo 64
};

}  // namespace regionmesh
