#include "simplify/thinning.h"

#include <gtest/gtest.h>

#include "mesh/strata.h"
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

Thinned thin(Mesh& mesh, int sweeps, double max_cost = 1e-3, const DecimateOptions& options = {}) {
    count_labels(mesh);
    FaceTree tree(mesh);
    VertexQuadrics quadrics(mesh);
    const ShapeBounds bounds{.min_quality = options.min_quality};
    Thinning thinning(mesh, tree, quadrics, options, bounds, max_cost);
    Thinned done;
    for (int n = 0; n < sweeps; ++n) done.removed += thinning.sweep(done.verdicts);
    return done;
}

Mesh grains() { return run(test::grain_volume({14, 14, 14}, 9, 5)).mesh; }
Mesh ball() { return run(test::ball_volume({16, 16, 16}, 6)).mesh; }

TEST(Thinning, takes_most_of_what_is_flat) {
    Mesh mesh = run(test::solid_volume({12, 12, 12})).mesh;
    const std::uint32_t before = mesh.face_count();
    const Thinned done = thin(mesh, 12);
    EXPECT_LT(mesh.face_count(), before / 4);
    EXPECT_EQ(before - mesh.face_count(), 2 * done.removed);
    EXPECT_EQ(done.verdicts[static_cast<int>(Verdict::kAccepted)], done.removed);
    test::expect_sound(check(mesh));
}

TEST(Thinning, keeps_all_strata_and_meets_nothing) {
    for (auto* make : {grains, ball}) {
        Mesh mesh = make();
        const test::StrataList strata = test::list_strata(mesh);
        EXPECT_GT(thin(mesh, 8, 1).removed, 0u);
        test::expect_same_strata(test::list_strata(mesh), strata);
        test::expect_sound(check(mesh));
    }
}

TEST(Thinning, holds_tangled_surfaces_apart) {
    for (std::uint32_t seed : {1u, 2u, 3u}) {
        Mesh mesh = run(test::noise_volume({9, 9, 9}, 4, seed)).mesh;
        thin(mesh, 8, 10, {.min_quality = 0});
        test::expect_sound(check(mesh));
    }
}

TEST(Thinning, without_the_intersection_test_still_keeps_faces_from_closing) {
    Mesh mesh = grains();
    const Thinned done = thin(mesh, 8, 1, {.intersect_check = false});
    EXPECT_GT(done.removed, 0u);
    EXPECT_EQ(done.verdicts[static_cast<int>(Verdict::kIntersect)], 0u);
    for (const Violation& violation : check(mesh).violations) EXPECT_EQ(violation.kind, ViolationKind::kCrossingFaces);
}

TEST(Thinning, moves_no_vertex) {
    Mesh mesh = ball();
    std::vector<Vec3> before;
    for (std::uint32_t v = 0; v < mesh.vertex_end(); ++v) before.push_back(mesh.position(VertexId{v}));
    thin(mesh, 4);
    test::for_vertices(mesh, [&](VertexId v) { EXPECT_EQ(mesh.position(v), before[index(v)]); });
}

TEST(Thinning, leaves_fixed_vertices_alone) {
    Mesh mesh = ball();
    std::uint32_t fixed = 0;
    for (std::uint32_t v = 0; v < mesh.vertex_end(); v += 3, ++fixed) mesh[VertexId{v}].is_fixed = true;
    const std::uint32_t before = mesh.vertex_count();
    const Thinned done = thin(mesh, 12);
    EXPECT_GT(done.removed, 0u);
    EXPECT_LE(done.removed, before - fixed);
    for (std::uint32_t v = 0; v < mesh.vertex_end(); v += 3) EXPECT_TRUE(mesh.is_alive(VertexId{v}));
    test::expect_sound(check(mesh));
}

TEST(Thinning, costs_no_more_than_the_level) {
    Mesh none = ball();
    const std::uint32_t before = none.face_count();
    thin(none, 4, -1);
    EXPECT_EQ(none.face_count(), before);
    Mesh cheap = ball(), dear = ball();
    thin(cheap, 8, 1e-4);
    thin(dear, 8, 1e-1);
    EXPECT_GT(cheap.face_count(), dear.face_count());
    Mesh exact = ball();
    thin(exact, 8, 1, {.max_error = 0});
    EXPECT_GE(exact.face_count(), cheap.face_count()) << "no more than what costs nothing";
}

TEST(Thinning, depends_on_the_model_alone) {
    Mesh first = grains(), second = grains();
    thin(first, 5);
    thin(second, 5);
    EXPECT_EQ(test::digest(first), test::digest(second));
}

TEST(Thinning, a_sweep_touches_no_star_twice) {
    Mesh mesh = run(test::solid_volume({12, 12, 12})).mesh;
    const std::uint32_t before = mesh.vertex_count();
    EXPECT_LT(thin(mesh, 1, 1e-3).removed, before / 3);
}

}  // namespace
}  // namespace regionmesh
