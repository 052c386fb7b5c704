// Kuhn's triangulation of the lattice: six tetrahedra per cell round the diagonal (0,0,0)-(1,1,1), which match inside
// the cell and across cells (docs/explanation/reconstruct.md).
#pragma once

#include <array>
#include <cstdint>

#include "regionmesh/vec3.h"

namespace regionmesh {

/// A step between two nodes of a cell: bit a set means +1 along axis a. 0 stays, 7 crosses the cell.
using Step = int;

/// Every simplex of the triangulation is a base node and a kind: the increasing chain of steps to its other nodes.
/// Kind 0 is the node itself, 1-7 the edges by step, 8-19 the triangles, 20-25 the tetrahedra.
struct SimplexKind {
    int node_count;
    std::array<Step, 4> steps;  // node_count of them; steps[0] = 0
};

inline constexpr int kKindCount = 26;
inline constexpr int kFirstTriangle = 8;
inline constexpr int kFirstTetrahedron = 20;

namespace detail {
constexpr bool is_below(Step a, Step b) { return a != b && (a & b) == a; }

constexpr std::array<SimplexKind, kKindCount> make_kinds() {
    std::array<SimplexKind, kKindCount> kinds{};
    kinds[0] = {1, {0, 0, 0, 0}};
    for (Step a = 1; a < 8; ++a) kinds[a] = {2, {0, a, 0, 0}};
    int triangle = kFirstTriangle, tetrahedron = kFirstTetrahedron;
    // The triangles in the plane of a section (steps without axis 2) come first: kinds 8 and 9.
    for (Step b = 1; b < 8; ++b)
        for (Step a = 1; a < b; ++a)
            if (is_below(a, b)) kinds[triangle++] = {3, {0, a, b, 0}};
    for (Step b = 1; b < 7; ++b)
        for (Step a = 1; a < b; ++a)
            if (is_below(a, b)) kinds[tetrahedron++] = {4, {0, a, b, 7}};
    return kinds;
}
}  // namespace detail

inline constexpr std::array<SimplexKind, kKindCount> kKinds = detail::make_kinds();

/// The kind with the given chain of steps (second and third 0 where there are fewer).
constexpr int kind_of(Step a, Step b = 0, Step c = 0) {
    for (int kind = 0; kind < kKindCount; ++kind)
        if (kKinds[kind].steps[1] == a && kKinds[kind].steps[2] == b && kKinds[kind].steps[3] == c) return kind;
    return -1;
}

/// Centroid of a simplex relative to its base node, in lattice units.
constexpr Vec3 centroid(int kind) {
    const SimplexKind& simplex = kKinds[kind];
    double sum[3] = {0, 0, 0};
    for (int n = 0; n < simplex.node_count; ++n)
        for (int axis = 0; axis < 3; ++axis) sum[axis] += simplex.steps[n] >> axis & 1;
    return {sum[0] / simplex.node_count, sum[1] / simplex.node_count, sum[2] / simplex.node_count};
}

/// The axes along which a simplex extends.
constexpr Step extent(int kind) {
    Step all = 0;
    for (Step step : kKinds[kind].steps) all |= step;
    return all;
}

}  // namespace regionmesh
