#include "regionmesh/decimate/thinning.h"

#include <gtest/gtest.h>

#include "regionmesh/model/strata.h"
#include "support/digest.h"
#include "support/runs.h"
#include "support/strata_list.h"

namespace regionmesh {
namespace {

using test::run;

struct Thinned {
    VerdictCounts verdicts{};
    std::uint32_t removed = 0;
};

Thinned thin(Model& model, int sweeps, double max_cost = 1e-3, const DecimateOptions& options = {}) {
    count_labels(model);
    FaceTree tree(model);
    VertexQuadrics quadrics(model);
    const ShapeBounds bounds{.min_quality = options.min_quality};
    Thinning thinning(model, tree, quadrics, options, bounds, max_cost);
    Thinned done;
    for (int n = 0; n < sweeps; ++n) done.removed += thinning.sweep(done.verdicts);
    return done;
}

Model grains() { return run(test::grain_volume({14, 14, 14}, 9, 5)).model; }
Model ball() { return run(test::ball_volume({16, 16, 16}, 6)).model; }

TEST(Thinning, takes_most_of_what_is_flat) {
    Model model = run(test::solid_volume({12, 12, 12})).model;
    const std::uint32_t before = model.face_count();
    const Thinned done = thin(model, 12);
    EXPECT_LT(model.face_count(), before / 4);
    EXPECT_EQ(before - model.face_count(), 2 * done.removed);
    EXPECT_EQ(done.verdicts[static_cast<int>(Verdict::kAccepted)], done.removed);
    test::expect_sound(check(model));
}

TEST(Thinning, keeps_all_strata_and_meets_nothing) {
    for (auto* make : {grains, ball}) {
        Model model = make();
        const test::StrataList strata = test::list_strata(model);
        EXPECT_GT(thin(model, 8, 1).removed, 0u);
        test::expect_same_strata(test::list_strata(model), strata);
        test::expect_sound(check(model));
    }
}

TEST(Thinning, holds_tangled_surfaces_apart) {
    for (std::uint32_t seed : {1u, 2u, 3u}) {
        Model model = run(test::noise_volume({9, 9, 9}, 4, seed)).model;
        thin(model, 8, 10, {.min_quality = 0});
        test::expect_sound(check(model));
    }
}

TEST(Thinning, without_the_intersection_test_still_keeps_faces_from_closing) {
    Model model = grains();
    const Thinned done = thin(model, 8, 1, {.intersect_check = false});
    EXPECT_GT(done.removed, 0u);
    EXPECT_EQ(done.verdicts[static_cast<int>(Verdict::kIntersect)], 0u);
    for (const Violation& violation : check(model).violations) EXPECT_EQ(violation.kind, ViolationKind::kCrossingFaces);
}

TEST(Thinning, moves_no_vertex) {
    Model model = ball();
    std::vector<Vec3> before;
    for (std::uint32_t v = 0; v < model.vertex_end(); ++v) before.push_back(model.position(VertexId{v}));
    thin(model, 4);
    test::for_vertices(model, [&](VertexId v) { EXPECT_EQ(model.position(v), before[index(v)]); });
}

TEST(Thinning, leaves_fixed_vertices_alone) {
    Model model = ball();
    std::uint32_t fixed = 0;
    for (std::uint32_t v = 0; v < model.vertex_end(); v += 3, ++fixed) model[VertexId{v}].is_fixed = true;
    const std::uint32_t before = model.vertex_count();
    const Thinned done = thin(model, 12);
    EXPECT_GT(done.removed, 0u);
    EXPECT_LE(done.removed, before - fixed);
    for (std::uint32_t v = 0; v < model.vertex_end(); v += 3) EXPECT_TRUE(model.is_alive(VertexId{v}));
    test::expect_sound(check(model));
}

TEST(Thinning, costs_no_more_than_the_level) {
    Model none = ball();
    const std::uint32_t before = none.face_count();
    thin(none, 4, -1);
    EXPECT_EQ(none.face_count(), before);
    Model cheap = ball(), dear = ball();
    thin(cheap, 8, 1e-4);
    thin(dear, 8, 1e-1);
    EXPECT_GT(cheap.face_count(), dear.face_count());
    Model exact = ball();
    thin(exact, 8, 1, {.max_error = 0});
    EXPECT_GE(exact.face_count(), cheap.face_count()) << "no more than what costs nothing";
}

TEST(Thinning, depends_on_the_model_alone) {
    Model first = grains(), second = grains();
    thin(first, 5);
    thin(second, 5);
    EXPECT_EQ(test::digest(first), test::digest(second));
}

TEST(Thinning, a_sweep_touches_no_star_twice) {
    Model model = run(test::solid_volume({12, 12, 12})).model;
    const std::uint32_t before = model.vertex_count();
    EXPECT_LT(thin(model, 1, 1e-3).removed, before / 3);
}

}  // namespace
}  // namespace regionmesh
