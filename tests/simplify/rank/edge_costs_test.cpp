#include "simplify/rank/edge_costs.h"

#include <gtest/gtest.h>

#include <tuple>

#include "mesh/strata.h"
#include "support/runs.h"

namespace regionmesh {
namespace {

std::vector<VertexId> neighbours_of(const Mesh& mesh, VertexId v) {
    std::vector<VertexId> found;
    mesh.for_star(v, [&](FaceId f, int place) {
        for (int step : {1, 2}) {
            const VertexId n = mesh[f].vertices[(place + step) % 3];
            if (std::find(found.begin(), found.end(), n) == found.end()) found.push_back(n);
        }
    });
    return found;
}

void expect_as_placed(const Mesh& mesh, double tolerance) {
    const VertexQuadrics quadrics(mesh);
    std::vector<EdgeCost> costs;
    test::for_vertices(mesh, [&](VertexId v) {
        const std::vector<VertexId> to = neighbours_of(mesh, v);
        find_edge_costs(mesh, quadrics, v, to, costs);
        for (std::size_t n = 0; n < to.size(); ++n) {
            // The end that stays has the sides of both.
            const bool v_stays = (mesh[to[n]].sides & ~mesh[v].sides) == 0;
            if (!v_stays && (mesh[v].sides & ~mesh[to[n]].sides) != 0) continue;
            const EdgeEnds edge = v_stays ? quadrics.ends(mesh, to[n], v) : quadrics.ends(mesh, v, to[n]);
            const double weight = edge.goes_quadric.unpack().weight() + edge.stays_quadric.unpack().weight();
            const double length_2 = length2(edge.goes - edge.stays);
            ASSERT_NEAR(costs[n].weight, weight, 1e-5 * weight);
            ASSERT_NEAR(costs[n].cost, least_cost(edge).cost, tolerance * weight * length_2);
            ASSERT_NEAR(costs[n].rank - costs[n].cost, kLengthShare * weight * length_2, 1e-5 * weight * length_2);
        }
    });
}

TEST(EdgeCosts, are_those_of_the_placement) {
    Mesh mesh = test::run(test::grain_volume({10, 9, 8}, 12, 3)).mesh;
    count_labels(mesh);
    expect_as_placed(mesh, 1e-5);
}

TEST(EdgeCosts, hold_for_very_small_and_large_models) {
    for (double scale : {1e-6, 1e6}) {
        Mesh mesh = test::run(test::noise_volume({6, 6, 6}, 3, 5)).mesh;
        test::for_vertices(mesh, [&](VertexId v) { mesh[v].position = scale * mesh[v].position; });
        count_labels(mesh);
        expect_as_placed(mesh, 1e-5);
    }
}

TEST(VertexQuadrics, are_the_same_on_several_threads) {
    Mesh mesh = test::run(test::noise_volume({7, 6, 5}, 4, 8)).mesh;
    count_labels(mesh);
    const VertexQuadrics alone(mesh, 1), together(mesh, 3);
    test::for_vertices(mesh, [&](VertexId v) {
        const PackedQuadric &a = alone[v], &b = together[v];
        ASSERT_GT(a.xx + a.yy + a.zz, 0);
        ASSERT_EQ(std::tuple(a.xx, a.xy, a.xz, a.yy, a.yz, a.zz), std::tuple(b.xx, b.xy, b.xz, b.yy, b.yz, b.zz));
    });
}

}  // namespace
}  // namespace regionmesh
