#include "simplify/sweep/half_candidates.h"

#include <gtest/gtest.h>

#include "support/runs.h"
#include "support/volumes.h"

namespace regionmesh {
namespace {

TEST(HalfCandidates, come_cheapest_first) {
    HalfCandidates edges(3);
    EXPECT_TRUE(edges.empty());
    edges.add({2, VertexId{4}, VertexId{5}});
    edges.add({1, VertexId{9}, VertexId{8}});
    edges.add({1, VertexId{9}, VertexId{7}});
    edges.add({0, VertexId{1}, VertexId{2}});  // no room
    EXPECT_EQ(edges.least_rank(), 1);
    EXPECT_EQ(edges.take().stays, VertexId{7});
    EXPECT_EQ(edges.take().stays, VertexId{8});
    EXPECT_EQ(edges.take().goes, VertexId{4});
    EXPECT_TRUE(edges.empty());
}

TEST(HalfCandidates, leave_fewer_faces_where_samples_forbid_the_best_places) {
    test::ArrayVolume volume = test::grain_volume({40, 36, 44}, 30, 3);
    const Reconstruction made = test::run(volume, {.reduce = 0.99, .background = {}});
    test::expect_sound(made.report.check);
    EXPECT_EQ(made.report.samples.value().wrong, 0u);
    EXPECT_LT(made.report.final_faces, 2150u);  // 2,363 where each edge has one place, 1,958 with second choices
}

}  // namespace
}  // namespace regionmesh
