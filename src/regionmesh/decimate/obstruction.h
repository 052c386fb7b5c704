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
    /// True when a new face would meet a face outside the star other than in shared vertices and edges, or when the star
    /// would sweep over a separate part of the surface. Requires that fold and pinch have passed with this position.
    bool blocks(const Model& model, const FaceTree& tree, const EdgeStar& star, Vec3 position);

private:
    struct LinkPoint {
        VertexId vertex;
        Vec3 at;
        enum { kUnknown, kSupports, kDoesNot } support;
    };

    void prepare(const Model& model, const EdgeStar& star, Vec3 position);
    bool is_flat_on_box(const Model& model, const EdgeStar& star) const;
    bool is_clear(const Model& model, FaceId f);
    Vec3 along_star(Vec3 step) const;
    bool is_behind(Vec3 out, const LinkPoint& point) const;
    bool is_beyond(Vec3 out, const std::array<Vec3, 3>& p) const;
    bool is_off_slab(const std::array<Vec3, 3>& p) const;
    bool supports_at(LinkPoint& point);
    bool supports_along(const LinkPoint& a, const LinkPoint& b, Vec3 x) const;
    bool meets_new_face(const Model& model, const EdgeStar& star, FaceId f) const;
    bool is_swept(const Model& model, const EdgeStar& star, Vec3 q) const;

    Vec3 position_;
    std::array<Vec3, 2> ends_;   // where the edge is now
    Vec3 normal_;                // sum of the new faces' normals
    double low_ = 0, high_ = 0;  // extent along it, from position_, of all that the star sweeps
    Box box_;                    // of all that the star sweeps
    std::vector<LinkPoint> link_;
    int shared_ = 0;             // of the face looked at last: corners that are link points
};

}  // namespace regionmesh
