#include "cells/kuhn.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "support/nodes.h"

namespace regionmesh {
namespace {

using test::node;

TEST(Kuhn, kinds_are_a_node_7_edges_12_triangles_and_6_tetrahedra) {
    std::array<int, 5> count{};
    std::set<std::array<Step, 4>> chains;
    for (const SimplexKind& kind : kKinds) {
        ++count[kind.node_count];
        chains.insert(kind.steps);
    }
    EXPECT_EQ(count, (std::array{0, 1, 7, 12, 6}));
    EXPECT_EQ(chains.size(), 26u) << "a kind occurs twice";
}

TEST(Kuhn, chains_increase) {
    for (const SimplexKind& kind : kKinds) {
        EXPECT_EQ(kind.steps[0], 0);
        for (int n = 1; n < kind.node_count; ++n) {
            EXPECT_NE(kind.steps[n], kind.steps[n - 1]);
            EXPECT_EQ(kind.steps[n] & kind.steps[n - 1], kind.steps[n - 1]);
        }
    }
}

TEST(Kuhn, kind_of_finds_each_chain) {
    for (int kind = 0; kind < kKindCount; ++kind)
        EXPECT_EQ(kind_of(kKinds[kind].steps[1], kKinds[kind].steps[2], kKinds[kind].steps[3]), kind);
    EXPECT_EQ(kind_of(1, 2), -1);
    EXPECT_EQ(kind_of(1, 3), kFirstTriangle);
    EXPECT_EQ(kind_of(1, 3, 7), kFirstTetrahedron);
}

TEST(Kuhn, tetrahedra_fill_the_cell_round_its_diagonal) {
    for (int kind = kFirstTetrahedron; kind < kKindCount; ++kind) {
        const auto& steps = kKinds[kind].steps;
        EXPECT_EQ(steps[3], 7);
        const double sixfold = dot(node(steps[1]), cross(node(steps[2]), node(steps[3])));
        EXPECT_EQ(std::abs(sixfold), 1) << "not a sixth of the cell";
    }
}

TEST(Kuhn, no_two_simplices_have_one_centroid) {
    std::set<std::array<double, 3>> places;
    for (int kind = 0; kind < kKindCount; ++kind) places.insert({centroid(kind).x, centroid(kind).y, centroid(kind).z});
    EXPECT_EQ(places.size(), 26u);
    EXPECT_EQ(centroid(7), (Vec3{0.5, 0.5, 0.5}));
    EXPECT_EQ(centroid(kFirstTetrahedron), (Vec3{0.75, 0.5, 0.25}));
}

TEST(Kuhn, extent_names_the_axes_of_a_simplex) {
    EXPECT_EQ(extent(0), 0);
    EXPECT_EQ(extent(5), 5);
    EXPECT_EQ(extent(kFirstTriangle), 3);
    for (int kind = kFirstTetrahedron; kind < kKindCount; ++kind) EXPECT_EQ(extent(kind), 7);
}

}  // namespace
}  // namespace regionmesh
