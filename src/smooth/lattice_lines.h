// Where vertices go in their lattice simplices: nearest to the interfaces estimated near them, and along fair lines.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/sliding_array.h"
#include "smooth/lattice_level.h"
#include "smooth/lattice_sites.h"

namespace regionmesh {

/// Least squares for a vertex: heights over its interfaces and distance to a given point, over steps in the affine hull
/// of its simplex. Lengths are in finest spacings.
struct NearestPoint {
    int count = 0;  // of edges from the first node
    std::array<std::array<double, 3>, 3> a{};
    std::array<double, 3> b{};

    /// The square of (height + slope . step) / |slope|.
    void add(const SiteEstimate& estimate, const SimplexEdges& edges);
    /// `weight` times the square of |step - target|.
    void add(Vec3 target, double weight, const SimplexEdges& edges);
    /// Coefficients of the edges; zero where there is nothing to go by.
    std::array<double, 3> solve() const;
    /// solve() is this matrix times b.
    std::array<std::array<double, 3>, 3> inverse() const;
};

/// Weights of the nodes at the solution; they may lie outside the simplex.
Barycentric weights_of(const std::array<double, 3>& coefficients, int count);

/// Vertices of triple lines, and quadruple points, with their neighbours along the lines. Sweeps draw each of them to
/// the mean of its neighbours.
class LatticeLines {
public:
    LatticeLines(const SurfaceWindow& window, const LatticeSites& sites, const LatticeMargins& margins)
        : window_(window), sites_(sites), margins_(margins) {
        first_node_.push_back(0);
    }

    static constexpr std::uint32_t kSweeps = 16;  // even: positions end where they began
    static constexpr double kPull = 12;           // weight of the mean of the neighbours, beside the interfaces

    /// Adds a vertex of the chunk that comes next, in order of number, and ends the chunk.
    void add(std::uint32_t vertex, const NearestPoint& to_interfaces, Vec3 position);
    void end_chunk() { first_node_.push_back(nodes_.end()); }
    /// Finds the neighbours of the vertices of a chunk. Requires that the next chunk was added, if there is one.
    void link(std::uint32_t chunk);
    /// Requires that the sweep before, or link(), has done the next chunk, if there is one.
    void sweep(std::uint32_t number, std::uint32_t chunk, std::uint32_t threads);
    /// After the last sweep.
    template <class Visit>
    void for_positions(std::uint32_t chunk, Visit&& visit) const {
        for (std::uint32_t n = first_node_[chunk]; n < first_node_[chunk + 1]; ++n)
            visit(nodes_[n].vertex, nodes_[n].at[0]);
    }

    void drop_before(std::uint32_t chunk);
    std::size_t bytes() const { return nodes_.bytes() + sides_.capacity() * sizeof(Side); }

private:
    struct Node {
        std::uint32_t vertex, count;
        std::array<std::uint32_t, 4> next;  // numbers of nodes
        NearestPoint nearest;               // to the interfaces; from link() on `a` is the inverse, with the pull in it
        LatticeSimplex simplex;
        std::array<Vec3, 2> at;
    };

    /// A half of an edge of a face, from a vertex of a line to another.
    struct Side {
        std::uint32_t from, to;  // nodes
        std::uint32_t order;
        std::array<Label, 2> labels;
    };

    void end_links(Node& node) const;

    std::uint32_t node_of(std::uint32_t vertex) const;

    const SurfaceWindow& window_;
    const LatticeSites& sites_;
    LatticeMargins margins_;
    SlidingArray<Node> nodes_;                // by vertex
    SlidingArray<std::uint32_t> first_node_;  // by chunk, and one more
    std::vector<Side> sides_;                 // of the chunk in link()
};

/// The simplex of a vertex in the window.
LatticeSimplex simplex_in(const SurfaceWindow& window, const LatticeSites& sites, std::uint32_t vertex);

}  // namespace regionmesh
