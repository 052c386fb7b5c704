// Where vertices go in their lattice simplices: nearest to the interfaces estimated near them, and along fair lines.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/lanes.h"
#include "base/sliding_array.h"
#include "base/sliding_pages.h"
#include "smooth/lattice/lattice_fits.h"
#include "smooth/packed_chunks.h"

namespace regionmesh {

/// Least squares for a vertex: heights over its interfaces and distance to a given point, over steps in the affine hull
/// of its simplex. Lengths are in finest spacings.
struct NearestPoint {
    int count = 0;  // count of edges from the first node
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
    LatticeLines(const LatticeFrame& frame, const LatticeMargins& margins) : frame_(frame), margins_(margins) {
        first_node_.push_back(0);
    }

    static constexpr std::uint32_t kSweeps = 16;  // even: positions end where they began
    static constexpr double kPull = 12;           // weight of the mean of the neighbours, beside the interfaces

    /// Is a vertex of this simplex one of these?
    static bool has(const LatticeSimplex& simplex) { return simplex.kind >= kFirstTriangle; }
    /// Adds a vertex of the chunk that comes next, in its order, and ends the chunk.
    void add(const LatticeSimplex& simplex, const NearestPoint& to_interfaces, const FixedWeights& weights);
    void end_chunk();
    /// Finds the neighbours of the vertices of a chunk. Chunks are linked in their order. Requires that the next chunk
    /// was added, if there is one. `parts` is for the use of this function.
    void link(std::uint32_t chunk, const PackedChunks& chunks, PackedChunks::Parts& parts);
    /// Requires that the sweep before, or link(), has done the next chunk, if there is one.
    void sweep(std::uint32_t number, std::uint32_t chunk, std::uint32_t threads);
    std::uint32_t first_of(std::uint32_t chunk) const { return first_node_[chunk]; }
    /// After the last sweep; `node` is first_of() its chunk and the number of vertices added to the chunk before it.
    Vec3 position(std::uint32_t node) const;

    void drop_before(std::uint32_t chunk);
    std::size_t bytes() const {
        return fours_.bytes() + at_[0].bytes() + at_[1].bytes() + equations_.bytes() +
               (sides_.capacity() + next_sides_.capacity()) * sizeof(Side);
    }

private:
    /// Four nodes: numbers are in their order, or one per lane. Weights are those of the nodes of a simplex but the
    /// first; without a pull they are `inset` + `margin` + `step`.
    struct Four {
        std::array<std::array<std::uint32_t, 4>, 4> next{};  // numbers of nodes
        std::array<std::array<std::uint32_t, 4>, 4> base{};  // base of the simplex; the last number is not used
        std::array<std::uint8_t, 4> kind{}, count{};         // kind of the simplex; of the neighbours
        std::array<Float4, 3> step{};
        std::array<std::array<Float4, 3>, 3> pull{};  // pull of each weight, by axis, of the sum of the neighbours
        Float4 margin{};
        Float4 inset = all_four(1), inset_third = all_four(1);  // inset of equal weights beyond the margin
        Float4 room = all_four(1);                              // room of the sum of the weights, beyond the margins

        void sweep(const Unsigned4* before, std::uint32_t first, Unsigned4* after) const;
    };

    /// A half of an edge of a face, from a vertex of a line to another.
    struct Side {
        std::uint32_t from, to;  // nodes
        std::uint32_t order;
        std::array<Label, 2> labels;
    };

    static constexpr std::uint32_t kNoNode = ~0u;

    void find_sides(std::uint32_t chunk, const PackedChunks::Parts& parts);
    void end_links(std::uint32_t node);

    LatticeFrame frame_;
    LatticeMargins margins_;
    SlidingPages<Four> fours_;
    // By node, in 2^-20 of a lattice unit, modulo 2^32: neighbours are never far. The last number is not used.
    std::array<SlidingArray<Unsigned4>, 2> at_;
    SlidingPages<NearestPoint> equations_;    // equations of the nodes whose neighbours are still to be found
    std::vector<std::uint32_t> carried_;      // nodes of the vertices that the next chunk to be linked carries
    SlidingArray<std::uint32_t> first_node_;  // one per chunk, and one more
    std::vector<Side> sides_, next_sides_;    // sides of the chunk linked next, and of the one after it
};

}  // namespace regionmesh
