#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "regionmesh/improve.h"
#include "regionmesh/simplify.h"
#include "support/runs.h"
#include "support/strata_list.h"

namespace regionmesh {
namespace {

using test::run;

TEST(RaiseFloor, leaves_no_face_of_grains_below_the_bound) {
    for (const double share : {0.5, 0.7, 0.9}) {
        test::ArrayVolume volume = test::grain_volume({30, 28, 26}, 20, 5);
        const Reconstruction made = run(volume, {.reduce = share, .background = {}});
        test::expect_sound(made.report.check);
        EXPECT_EQ(made.report.samples.value().wrong, 0u);
        EXPECT_EQ(made.report.floor.value().below_after, 0u);
        EXPECT_GE(made.report.check.quality.min, 0.1);
        EXPECT_LE(made.mesh.face_count(), std::llround(made.report.initial_faces * (1 - share)));
    }
}

TEST(RaiseFloor, keeps_strata_and_samples_of_noise_and_lowers_no_worst_quality) {
    for (const std::uint64_t seed : {1, 2, 3}) {
        test::ArrayVolume volume = test::noise_volume({9, 8, 10}, 3, seed);
        Mesh mesh = run(volume, {.background = {}}).mesh;
        const test::StrataList strata = test::list_strata(mesh);
        const FloorResult done = raise_floor(mesh, {.samples = volume.info().lattice});
        EXPECT_LT(done.below_after, done.below_before);
        EXPECT_GE(done.lowest_after, done.lowest_before);
        EXPECT_EQ(done.left.size(), std::min<std::size_t>(done.below_after, FloorResult::kMostLeft));
        test::expect_same_strata(test::list_strata(mesh), strata);
        test::expect_sound(check(mesh));
    }
}

TEST(RaiseFloor, does_nothing_to_a_mesh_above_the_bound) {
    Mesh mesh = run(test::ball_volume({12, 12, 12}, 4.2), {.smooth = {.passes = 0}, .background = {}}).mesh;
    const std::uint32_t faces = mesh.face_count();
    const FloorResult done = raise_floor(mesh, {.min_quality = 0.02});
    EXPECT_EQ(done.below_before, 0u);
    EXPECT_EQ(done.collapses + done.flips + done.moves + done.splits, 0u);
    EXPECT_EQ(mesh.face_count(), faces);
}

TEST(RaiseFloor, of_nothing_is_nothing) {
    Mesh mesh;
    EXPECT_EQ(raise_floor(mesh, {}).lowest_after, 0);
}

}  // namespace
}  // namespace regionmesh
