// The connected solid parts of a mesh: the boundary of each, and a point inside.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "mesh/exact_ray.h"
#include "mesh/sorted_face_tree.h"
#include "regionmesh/mesh.h"

namespace regionmesh {

/// One side of a face: 2 f is the side of its first label, 2 f + 1 that of its second.
using FaceSide = std::uint32_t;
constexpr FaceSide face_side(FaceId f, int side) { return 2 * index(f) + static_cast<FaceSide>(side); }
constexpr FaceId face_of(FaceSide side) { return FaceId{side >> 1}; }

/// A connected part of the space of one label; all six exteriors count as exterior(0).
struct Body {
    Label label = 0;
    bool is_bounded = false;            // false: unbounded, without an outer shell
    double volume = 0;                  // 0 if unbounded
    std::vector<std::uint32_t> shells;  // if bounded: the outer shell, then those of the cavities
};

/// A shell is a connected part of the boundary of a body: sides of faces with one label, joined across edges. Shells
/// are numbered from 0 in order of their first side. Exact tests decide which cavity lies in which body. Requires a
/// mesh without crossing faces and without a face that has one label on both sides. If more than two faces of a label
/// share an edge, their sides are joined in their order around it. Needs about 100 bytes per face temporarily.
class Bodies {
public:
    explicit Bodies(const Mesh& mesh);
    Bodies(const Bodies&) = delete;
    Bodies& operator=(const Bodies&) = delete;

    /// Bodies in order of their first side.
    const std::vector<Body>& all() const { return bodies_; }
    std::uint32_t shell_count() const { return static_cast<std::uint32_t>(shell_starts_.size()) - 1; }
    std::uint32_t shell(FaceSide side) const { return shells_[side]; }
    std::span<const FaceSide> sides(std::uint32_t shell) const {
        return std::span(sides_).subspan(shell_starts_[shell], shell_starts_[shell + 1] - shell_starts_[shell]);
    }

    /// A point strictly inside a bounded body and well away from its boundary, proved by an exact count of the faces
    /// between it and the outside. nullopt if none was found: the body is then thinner than doubles can resolve.
    std::optional<Vec3> point_inside(const Body& body) const;

private:
    std::vector<bool> list_shells();
    double enclosed_volume(std::uint32_t shell) const;
    void make_bodies(const std::vector<bool>& is_open);
    std::optional<std::uint32_t> body_round(std::uint32_t cavity) const;
    bool is_inside(Vec3 point, const Body& body) const;
    struct Candidate {
        Vec3 point;
        double depth = 0;
    };
    Candidate candidate_below(FaceSide side) const;

    const Mesh& mesh_;
    SortedFaceTree tree_;
    ExactRay ray_;
    std::vector<std::uint32_t> shells_;        // shell of each side
    std::vector<FaceSide> sides_;              // grouped by shell
    std::vector<std::uint32_t> shell_starts_;  // start of each shell in sides_, and the end
    std::vector<std::uint32_t> shell_bodies_;  // body of each shell, once known
    std::vector<Body> bodies_;
};

}  // namespace regionmesh
