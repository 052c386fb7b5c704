// Whether triangles can meet when their vertices go anywhere in their lattice simplices.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <unordered_map>
#include <utility>
#include <vector>

#include "cells/cell_partition.h"

namespace regionmesh::cell_table {

/// A face of a cell: each vertex lies in a simplex.
using Triangle = std::array<NodeSet, 3>;

inline bool has(const Triangle& triangle, NodeSet vertex) {
    return triangle[0] == vertex || triangle[1] == vertex || triangle[2] == vertex;
}

/// Sides of the cell that a simplex lies in, as bits.
unsigned sides_of(NodeSet simplex);

/// Answers hold for all positions at once. Vertices go anywhere in the interior of their simplices, but for triangles
/// on the main diagonal, where weights stay above kInnerMargin.
///
/// The determinant that tells on which side of a plane a point lies is linear in each of the four points, so its least
/// and greatest values lie at corners of their ranges: whole numbers, of which there are at most 4^4.
class AnyPosition {
public:
    static constexpr int kTenths = 3;  // kInnerMargin in tenths

    /// True if the triangles meet in what they share only: some plane through three of their vertices and the nodes of
    /// the cell parts them wherever the vertices are. False if there is no such plane; they may still never meet.
    bool are_apart(const Triangle& a, const Triangle& b);

private:
    enum class Side : std::uint8_t { kOn, kBelow, kAbove, kDepends };
    using Corner = std::array<std::int64_t, 3>;  // coordinates in tenths

    static std::vector<Corner> range_of(NodeSet simplex);
    Side side(const Triangle& plane, NodeSet point);
    bool parts(const Triangle& plane, const Triangle& a, const Triangle& b);

    std::unordered_map<std::uint32_t, Side> sides_;
    std::map<std::pair<Triangle, Triangle>, bool> apart_;
};

}  // namespace regionmesh::cell_table
