// Where vertices go in their lattice simplices: nearest to the interfaces estimated near them, and along fair lines.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "smooth/lattice_level.h"
#include "smooth/lattice_sites.h"

namespace regionmesh {

/// Least squares for a vertex: heights over its interfaces and distance to a given point, over steps in the affine hull
/// of its simplex.
struct NearestPoint {
    int count;  // of edges from the first node
    std::array<std::array<double, 3>, 3> a{};
    std::array<double, 3> b{};

    /// The square of (height + slope . step) / |slope|.
    void add(const SiteEstimate& estimate, const SimplexEdges& edges);
    /// `weight` times the square of |step - target|.
    void add(Vec3 target, double weight, const SimplexEdges& edges);
    /// Coefficients of the edges; zero where there is nothing to go by.
    std::array<double, 3> solve() const;
};

/// Weights of the nodes at the solution; they may lie outside the simplex.
Barycentric weights_of(const NearestPoint& nearest);

/// Vertices of triple lines, and quadruple points, with their neighbours along the lines.
class LatticeLines {
public:
    LatticeLines(std::span<const LatticeSimplex> simplices, std::span<const LatticeFace> faces);

    struct Node {
        std::uint32_t vertex;
        int count = 0;
        std::array<std::uint32_t, 4> next{};  // numbers of nodes
        NearestPoint nearest{0};              // to the interfaces
        Vec3 centroid;
    };
    std::vector<Node>& nodes() { return nodes_; }

    /// Sweeps that draw each vertex to the mean of its neighbours as well, with weight kPull; positions by vertex.
    void fair(std::span<Vec3> positions, std::span<const LatticeSimplex> simplices, const LatticeFrame& frame,
              double margin) const;

    static constexpr int kSweeps = 12;
    static constexpr double kPull = 1;

private:
    std::vector<Node> nodes_;
};

}  // namespace regionmesh
