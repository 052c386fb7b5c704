// Vertices as each interface sees them: what the fits of the lattice filter are made from.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "regionmesh/label.h"
#include "regionmesh/vec3.h"
#include "smooth/lattice_simplex.h"

namespace regionmesh {

inline constexpr std::uint32_t kNoSite = 0xFFFFFFFFu;

/// A vertex in one interface between two regions. A vertex of an interface has one, of a triple line three, of a
/// quadruple point six.
struct LatticeSite {
    Vec3 position;            // centroid of its simplex
    Vec3 normal;              // of the unsmoothed interface near by, unit length; from the first label to the second
    std::uint32_t interface;  // number of its pair of labels
    std::uint8_t kind;        // of its simplex
};

struct LatticeSites {
    std::vector<LatticeSite> sites;    // in order of first use by a face
    std::vector<std::uint32_t> first;  // site of each vertex, or kNoSite
    std::vector<std::uint32_t> next;   // next site of the same vertex, or kNoSite
};

struct LatticeFace {
    std::array<std::uint32_t, 3> vertices;
    std::array<Label, 2> labels;  // the normal points from the first to the second
};

/// Faces with the exterior have no sites: the box is plane. Deterministic.
LatticeSites find_sites(std::span<const Vec3> positions, std::span<const LatticeSimplex> simplices,
                        std::span<const LatticeFace> faces);

}  // namespace regionmesh
