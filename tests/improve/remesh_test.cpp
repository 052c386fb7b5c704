#include "regionmesh/remesh.h"

#include <gtest/gtest.h>

#include <cmath>

#include "regionmesh/error.h"
#include "regionmesh/simplify.h"
#include "support/runs.h"
#include "support/strata_list.h"

namespace regionmesh {
namespace {

using test::run;

TEST(Remesh, brings_the_edges_of_a_ball_near_the_wanted_length_from_above_and_below) {
    for (const double wanted : {1.0, 2.0, 3.0}) {
        test::ArrayVolume volume = test::ball_volume({40, 40, 40}, 16);
        const Reconstruction made = run(volume, {.edge_length = wanted, .free_error = 0.05, .background = {}});
        test::expect_sound(made.report.check);
        EXPECT_EQ(made.report.samples.value().wrong, 0u);
        const RemeshResult& done = made.report.remeshed.value();
        EXPECT_LT(done.before.share(), 0.8);
        EXPECT_GT(done.after.share(), 0.95) << wanted;
        EXPECT_NEAR(done.after.mean, wanted, 0.1 * wanted);
    }
}

TEST(Remesh, keeps_strata_and_samples_of_grains) {
    test::ArrayVolume volume = test::grain_volume({30, 28, 26}, 12, 5);
    Mesh mesh = run(volume, {.background = {}}).mesh;
    const test::StrataList strata = test::list_strata(mesh);
    const RemeshResult done = remesh(mesh, {.promises = {.samples = volume.info().lattice}, .edge_length = 2});
    EXPECT_GT(done.after.share(), 0.8);
    test::expect_same_strata(test::list_strata(mesh), strata);
    test::expect_sound(check(mesh));
}

TEST(Remesh, keeps_the_largest_error) {
    test::ArrayVolume volume = test::grain_volume({20, 20, 20}, 6, 3);
    Mesh mesh = run(volume, {.background = {}}).mesh;
    const RemeshResult done = remesh(mesh, {.promises = {.max_error = 0.1}, .edge_length = 3});
    EXPECT_GT(done.collapses, 0u);
    EXPECT_LE(done.error_bound, 0.1 + 1e-6);
}

TEST(Remesh, refuses_a_length_that_is_none) {
    Mesh mesh;
    for (const double wanted : {0.0, -1.0, std::nan("")}) EXPECT_THROW(remesh(mesh, {.edge_length = wanted}), Error);
    EXPECT_EQ(remesh(mesh, {.edge_length = 1}).after.edges, 0u);
}

}  // namespace
}  // namespace regionmesh
