// The directions along which faces rise: lets the intersection test skip most faces near a star.
#pragma once

#include <cstdint>
#include <vector>

#include "judge/edge_star.h"
#include "regionmesh/mesh.h"

namespace regionmesh {

/// A set of 26 directions: bit k for one of 13, bit 16 + k for its opposite.
using Directions = std::uint32_t;

/// The directions along which each face rises: those that make less than 87 degrees with its normal.
class RisingFaces {
public:
    explicit RisingFaces(const Mesh& mesh) { build(mesh); }

    /// Computes all directions anew, of the living faces.
    void build(const Mesh& mesh);
    /// Updates the faces of a star, which are at their new place. Requires its new normals (set_normals).
    void set(const EdgeStar& star, Vec3 position);

    Directions operator[](FaceId f) const { return directions_[index(f)]; }
    /// The directions along which all faces of a star rise, before and after the collapse. Requires its new normals
    /// (set_normals).
    Directions common(const EdgeStar& star, Vec3 position) const;

    std::size_t bytes() const { return directions_.capacity() * sizeof(Directions); }

private:
    std::vector<Directions> directions_;  // by face
};

}  // namespace regionmesh
