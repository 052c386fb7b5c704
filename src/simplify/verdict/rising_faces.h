// Along which directions faces rise: most faces near a star are of the same sheet and need no closer look.
#pragma once

#include <cstdint>
#include <vector>

#include "regionmesh/mesh.h"
#include "simplify/edge_star.h"

namespace regionmesh {

/// A set of 26 directions: bit k for one of 13, bit 16 + k for its opposite.
using Directions = std::uint32_t;

/// The directions along which each face rises: those that make less than 87 degrees with its normal.
class RisingFaces {
public:
    explicit RisingFaces(const Mesh& mesh) { build(mesh); }

    /// Anew, from the living faces.
    void build(const Mesh& mesh);
    /// Takes in the faces of a star at their new place. Requires its normals.
    void set(const EdgeStar& star, Vec3 position);

    Directions operator[](FaceId f) const { return directions_[index(f)]; }
    /// Along which the whole star of an interface rises, before the collapse and after. Requires its normals.
    Directions common(const EdgeStar& star, Vec3 position) const;

    std::size_t bytes() const { return directions_.capacity() * sizeof(Directions); }

private:
    std::vector<Directions> directions_;  // by face
};

}  // namespace regionmesh
