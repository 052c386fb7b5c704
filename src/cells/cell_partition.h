// The cell of eight samples: its simplices, its symmetries, and the ways in which labels part its nodes.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "cells/kuhn.h"
#include "regionmesh/label.h"

namespace regionmesh {

/// A simplex of a cell by its nodes: bit n stands for the node at Step n.
using NodeSet = std::uint8_t;

inline constexpr int kCellSimplexCount = 43;  // 19 edges, 18 triangles, 6 tetrahedra

/// The simplices of a cell with two nodes or more, in increasing order.
inline constexpr std::array<NodeSet, kCellSimplexCount> kCellSimplices = [] {
    std::array<NodeSet, kCellSimplexCount> simplices{};
    int count = 0;
    for (int set = 0; set < 256; ++set) {
        if (std::popcount(static_cast<unsigned>(set)) < 2) continue;
        bool is_chain = true;
        for (Step a = 0; a < 8; ++a)
            for (Step b = 0; b < a; ++b)
                if (set >> a & 1 && set >> b & 1) is_chain &= (a & b) == b;
        if (is_chain) simplices[count++] = static_cast<NodeSet>(set);
    }
    return simplices;
}();

inline constexpr NodeSet kMainDiagonal = 0b10000001;

/// Index of a simplex in kCellSimplices.
constexpr int place_in_cell(NodeSet simplex) {
    return static_cast<int>(std::find(kCellSimplices.begin(), kCellSimplices.end(), simplex) - kCellSimplices.begin());
}

/// Labels of the nodes up to their names: each node has the number of the first node with the same label.
using Partition = std::array<std::uint8_t, 8>;

template <class L>
constexpr Partition partition_of(const std::array<L, 8>& labels) {
    Partition partition{};
    for (std::uint8_t n = 0; n < 8; ++n) {
        partition[n] = n;
        for (int m = n - 1; m >= 0; --m)
            if (labels[m] == labels[n]) partition[n] = static_cast<std::uint8_t>(m);
    }
    return partition;
}

inline constexpr int kPartitionNumbers = 40320;  // 4,140 of them are used

constexpr int number_of(const Partition& partition) {
    int number = 0;
    for (int n = 1; n < 8; ++n) number = number * (n + 1) + partition[n];
    return number;
}

/// A map of the cell onto itself that maps its simplices to simplices: axes are exchanged, or all are turned round,
/// too.
struct CellSymmetry {
    std::array<std::uint8_t, 8> node{};  // image of each node
    bool mirrors = false;

    constexpr NodeSet operator()(NodeSet set) const {
        NodeSet image = 0;
        for (int n = 0; n < 8; ++n)
            if (set >> n & 1) image |= static_cast<NodeSet>(1 << node[n]);
        return image;
    }
    constexpr Partition operator()(const Partition& partition) const {
        std::array<std::uint8_t, 8> labels{};
        for (int n = 0; n < 8; ++n) labels[node[n]] = partition[n];
        return partition_of(labels);
    }
};

inline constexpr std::array<CellSymmetry, 12> kCellSymmetries = [] {
    std::array<CellSymmetry, 12> symmetries{};
    int count = 0;
    for (int x = 0; x < 3; ++x)
        for (int y = 0; y < 3; ++y) {
            if (x == y) continue;
            const int z = 3 - x - y;
            for (const bool is_turned : {false, true}) {
                CellSymmetry& made = symmetries[count++];
                made.mirrors = ((x + 1) % 3 == y) == is_turned;
                for (int n = 0; n < 8; ++n) {
                    const int image = (n & 1) << x | (n >> 1 & 1) << y | (n >> 2 & 1) << z;
                    made.node[n] = static_cast<std::uint8_t>(is_turned ? 7 - image : image);
                }
            }
        }
    return symmetries;
}();

/// Calls visit(partition) for all 4,140 partitions, in lexicographic order.
template <class Visit>
void for_each_partition(Visit&& visit) {
    Partition partition{};
    const auto next = [&](auto&& self, std::uint8_t n) -> void {
        if (n == 8) return visit(Partition(partition));
        for (std::uint8_t m = 0; m <= n; ++m) {
            if (m < n && partition[m] != m) continue;
            partition[n] = m;
            self(self, n + 1);
        }
    };
    next(next, 1);
}

/// The face rule: a curve on a side of a cell passes from lattice edge to lattice edge past the diagonal, which has no
/// vertex, unless three labels meet in one of the two triangles of the side. Labels of the nodes of the side; 0 and 3
/// are the ends of the diagonal.
template <class L>
constexpr bool drops_diagonal(const std::array<L, 4>& labels) {
    return labels[0] != labels[3] && (labels[1] == labels[0] || labels[1] == labels[3]) &&
           (labels[2] == labels[0] || labels[2] == labels[3]);
}

/// The corners of a side (2 * axis, and 1 more for the high one): its first, those one step along either axis, the
/// first step turns into the second anticlockwise as seen from the high end of the axis, and the opposite one.
constexpr std::array<Step, 4> corners_of_side(int side) {
    const int axis = side / 2;
    const Step base = side % 2 ? 1 << axis : 0, s = 1 << (axis + 1) % 3, t = 1 << (axis + 2) % 3;
    return {base, base | s, base | t, base | s | t};
}

constexpr std::array<Label, 4> labels_at(const std::array<Label, 8>& labels, const std::array<Step, 4>& corners) {
    return {labels[corners[0]], labels[corners[1]], labels[corners[2]], labels[corners[3]]};
}

/// The same for the diagonal of a side of a cell, which has two nodes that differ along two axes.
template <class L>
constexpr bool drops_diagonal(NodeSet diagonal, const std::array<L, 8>& labels) {
    const auto set = static_cast<unsigned>(diagonal);
    const int low = std::countr_zero(set), high = std::bit_width(set) - 1;
    const int across = high - low, first = across & -across;
    return drops_diagonal(
        std::array<L, 4>{labels[low], labels[low | first], labels[low | (across ^ first)], labels[high]});
}

}  // namespace regionmesh
