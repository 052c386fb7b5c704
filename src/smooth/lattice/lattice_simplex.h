// The lattice simplex that a vertex of the reconstruction belongs to, and positions strictly inside it.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "cells/kuhn.h"
#include "regionmesh/vec3.h"
#include "smooth/tuning.h"
#include "surface/chunk.h"

namespace regionmesh {

/// Node (i, j, k) of the lattice lies at origin + (i, j, k) * spacing.
struct LatticeFrame {
    Vec3 origin{0, 0, 0};
    Vec3 spacing{1, 1, 1};

    double finest() const { return std::min({spacing.x, spacing.y, spacing.z}); }
    /// Are samples along one axis much farther apart than along another?
    bool is_anisotropic() const {
        return std::max({spacing.x, spacing.y, spacing.z}) >= smoothing::kAnisotropic * finest();
    }
    /// The coordinate of a place in lattice units.
    double at(int axis, double units) const { return origin[axis] + units * spacing[axis]; }
};

/// By kind, in lattice units.
inline constexpr std::array<Vec3, kKindCount> kCentroids = [] {
    std::array<Vec3, kKindCount> centroids{};
    for (int kind = 0; kind < kKindCount; ++kind) centroids[kind] = centroid(kind);
    return centroids;
}();

/// Weights of the nodes of a simplex, in the order of kKinds; they add up to 1.
using Barycentric = std::array<double, 4>;

struct LatticeSimplex {
    Vec3 base;  // first node, in whole lattice units
    std::uint8_t kind = 0;

    int node_count() const { return kKinds[kind].node_count; }
};

inline LatticeSimplex simplex_of(const VertexSimplex& key) {
    return {{double(key.base[0]), double(key.base[1]), double(key.base[2])}, key.kind};
}

/// The position of an unsmoothed vertex, bit for bit as the mesher makes it.
inline double centroid_along(int axis, const LatticeSimplex& simplex, const LatticeFrame& frame) {
    return frame.at(axis, simplex.base[axis] + kCentroids[simplex.kind][axis]);
}
inline Vec3 centroid_in(const LatticeSimplex& simplex, const LatticeFrame& frame) {
    return {centroid_along(0, simplex, frame), centroid_along(1, simplex, frame), centroid_along(2, simplex, frame)};
}

/// The least weights of the nodes of a vertex's simplex.
struct LatticeMargins {
    double all;
    double inner;  // in triangles on the main diagonal of a cell

    double of(int kind) const {
        const bool is_inner = kKinds[kind].node_count == 3 && kKinds[kind].steps[2] == 7;
        return is_inner && inner > all ? inner : all;
    }
};

/// Moves weights into the smaller simplex in which none is below `margin`. Keeps weights that are there already.
/// Requires margin < 1 / node_count.
Barycentric clamp_inside(const Barycentric& weights, int node_count, double margin);

/// Weights of the nodes but the first as multiples of 2^-20.
inline constexpr int kWeightBits = 20;
inline constexpr double kWeightUnit = 1 << kWeightBits;
using FixedWeights = std::array<std::uint32_t, 3>;
FixedWeights rounded(const Barycentric& weights, int node_count);

/// The point of the simplex with the given weights. Coordinates in lattice units are multiples of 2^-20, so that with
/// unit spacing the point lies exactly in the simplex; along axes in which the simplex does not extend it has the exact
/// coordinate of the node.
Vec3 position_in(const LatticeSimplex& simplex, const FixedWeights& weights, const LatticeFrame& frame);

/// Edge vectors from the first node to the others, in the unit of the spacing.
struct SimplexEdges {
    int count;
    std::array<Vec3, 3> edges;
};
SimplexEdges edges_of(int kind, Vec3 spacing);

}  // namespace regionmesh
