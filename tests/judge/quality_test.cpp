#include "judge/verdict/quality.h"

#include <gtest/gtest.h>

#include "judge/verdict/verdicts.h"
#include "mesh/strata.h"
#include "support/runs.h"

namespace regionmesh {
namespace {

/// Of a vertex that goes to a neighbour, found in three ways.
void expect_alike(Mesh& mesh, VertexId goes, VertexId stays, int (&refused)[2]) {
    const Promises promises{.min_quality = 0.2};
    const Judge judge(mesh, promises, {.sees_others = false});
    Change change;
    EdgeStar& star = change.star;
    const Vec3 at_stays = mesh.position(stays);
    gather(mesh, goes, stays, star);
    const double of_edge = fan_quality3(mesh, star, stays, at_stays, judge.bounds());
    gather_vertex(mesh, goes, star);
    ASSERT_EQ(fan_quality3(mesh, star, stays, at_stays, judge.bounds()), of_edge);
    gather_half(mesh, goes, stays, star);
    const Verdict verdict = shape_verdict(judge, change, at_stays);
    const bool is_refused = verdict == Verdict::kFold || verdict == Verdict::kQuality;
    ASSERT_EQ(of_edge == 0, is_refused);
    if (!is_refused) {
        ASSERT_EQ(change.worst_quality3, of_edge);
    }
    ++refused[is_refused];
}

TEST(FanQuality, is_that_of_the_half_collapse_from_every_star) {
    Mesh mesh = test::run(test::noise_volume({7, 7, 7}, 3, 4)).mesh;
    count_labels(mesh);
    int refused[2] = {};
    test::for_vertices(mesh, [&](VertexId v) {
        mesh.for_star(
            v, [&](FaceId f, int place) { expect_alike(mesh, v, mesh[f].vertices[place_after(place)], refused); });
    });
    EXPECT_GT(refused[0], 500);
    EXPECT_GT(refused[1], 500);
}

}  // namespace
}  // namespace regionmesh
