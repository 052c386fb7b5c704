// The solid parts of a model: what bounds each of them, and a point inside.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "mesh/exact_ray.h"
#include "mesh/sorted_face_tree.h"
#include "regionmesh/mesh.h"

namespace regionmesh {

/// One side of a face: 2 f is that of its first label, 2 f + 1 that of its second.
using FaceSide = std::uint32_t;
constexpr FaceSide face_side(FaceId f, int side) { return 2 * index(f) + static_cast<FaceSide>(side); }
constexpr FaceId face_of(FaceSide side) { return FaceId{side >> 1}; }

/// A connected part of the space that one label fills; all six sides of the exterior count as exterior(0).
struct Body {
    Label label = 0;
    bool is_bounded = false;            // false: it reaches the outside, and has no outer shell
    double volume = 0;                  // of a bounded one
    std::vector<std::uint32_t> shells;  // a bounded one: the outer shell, then those of its cavities
};

/// A shell is a connected part of the boundary of a body: sides of faces with one label, joined across edges. Shells
/// count from 0 in order of their first side. Which cavity lies in which body is decided exactly. Requires a model
/// without crossings and with no face between two sides of one label; where more than two faces of a label share an
/// edge, their sides are joined as they follow one another round it. Cost: some hundred bytes a face, for a while.
class Bodies {
public:
    explicit Bodies(const Mesh& mesh);
    Bodies(const Bodies&) = delete;
    Bodies& operator=(const Bodies&) = delete;

    /// In order of their first side.
    const std::vector<Body>& all() const { return bodies_; }
    std::uint32_t shell_count() const { return static_cast<std::uint32_t>(shell_starts_.size()) - 1; }
    std::uint32_t shell(FaceSide side) const { return shells_[side]; }
    std::span<const FaceSide> sides(std::uint32_t shell) const {
        return std::span(sides_).subspan(shell_starts_[shell], shell_starts_[shell + 1] - shell_starts_[shell]);
    }

    /// A point strictly inside a bounded body and well away from its boundary, proved by an exact count of the faces
    /// between it and the outside. Nothing where none was found, which takes a body thinner than doubles can tell.
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
    std::vector<std::uint32_t> shells_;        // by side
    std::vector<FaceSide> sides_;              // shell after shell
    std::vector<std::uint32_t> shell_starts_;  // in sides_, and the end
    std::vector<std::uint32_t> shell_bodies_;  // by shell: its body, once it has one
    std::vector<Body> bodies_;
};

}  // namespace regionmesh
