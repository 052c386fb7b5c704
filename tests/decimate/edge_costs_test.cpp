#include "regionmesh/decimate/edge_costs.h"

#include <gtest/gtest.h>

#include "regionmesh/model/strata.h"
#include "support/runs.h"

namespace regionmesh {
namespace {

std::vector<VertexId> neighbours_of(const Model& model, VertexId v) {
    std::vector<VertexId> found;
    model.for_star(v, [&](FaceId f, int place) {
        for (int step : {1, 2}) {
            const VertexId n = model[f].vertices[(place + step) % 3];
            if (std::find(found.begin(), found.end(), n) == found.end()) found.push_back(n);
        }
    });
    return found;
}

void expect_as_placed(const Model& model, double tolerance) {
    const VertexQuadrics quadrics(model);
    std::vector<EdgeCost> costs;
    test::for_vertices(model, [&](VertexId v) {
        const std::vector<VertexId> to = neighbours_of(model, v);
        find_edge_costs(model, quadrics, v, to, costs);
        for (std::size_t n = 0; n < to.size(); ++n) {
            // The end that stays has the sides of both.
            const bool v_stays = (model[to[n]].sides & ~model[v].sides) == 0;
            if (!v_stays && (model[v].sides & ~model[to[n]].sides) != 0) continue;
            const EdgeEnds edge = v_stays ? quadrics.ends(model, to[n], v) : quadrics.ends(model, v, to[n]);
            const double weight = edge.goes_quadric.unpack().weight() + edge.stays_quadric.unpack().weight();
            const double length_2 = length2(edge.goes - edge.stays);
            ASSERT_NEAR(costs[n].weight, weight, 1e-5 * weight);
            ASSERT_NEAR(costs[n].cost, place(edge).cost, tolerance * weight * length_2);
            ASSERT_NEAR(costs[n].rank - costs[n].cost, kLengthShare * weight * length_2, 1e-5 * weight * length_2);
        }
    });
}

TEST(EdgeCosts, are_those_of_the_placement) {
    Model model = test::run(test::grain_volume({10, 9, 8}, 12, 3)).model;
    count_labels(model);
    expect_as_placed(model, 1e-5);
}

TEST(EdgeCosts, hold_for_very_small_and_large_models) {
    for (double scale : {1e-6, 1e6}) {
        Model model = test::run(test::noise_volume({6, 6, 6}, 3, 5)).model;
        test::for_vertices(model, [&](VertexId v) { model[v].position = scale * model[v].position; });
        count_labels(model);
        expect_as_placed(model, 1e-5);
    }
}

}  // namespace
}  // namespace regionmesh
