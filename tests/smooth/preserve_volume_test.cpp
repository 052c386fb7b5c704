#include <gtest/gtest.h>

#include "mesh/region_volumes.h"
#include "regionmesh/smooth.h"
#include "support/digest.h"
#include "support/runs.h"

namespace regionmesh {
namespace {

ReconstructOptions preserving(ReconstructOptions options) {
    options.smooth = {};
    options.preserve_volume = true;
    return options;
}

TEST(RegionVolumes, sum_to_that_of_the_box) {
    const Mesh mesh = test::run(test::grain_volume({9, 8, 7}, 5, 2)).mesh;
    double sum = 0;
    for (double volume : region_volumes(mesh)) {
        EXPECT_GT(volume, 0);
        sum += volume;
    }
    EXPECT_NEAR(sum, 8 * 7 * 6, 1e-9);
}

TEST(PreserveVolume, gives_a_shrunk_ball_its_volume_back) {
    Mesh mesh = test::run(test::ball_volume({21, 21, 21}, 7)).mesh;
    const std::vector<double> before = region_volumes(mesh);
    smooth(mesh, {.filter = SmoothFilter::kLaplacian, .passes = 40});
    EXPECT_LT(region_volumes(mesh)[1], 0.97 * before[1]);
    const PreserveReport report = preserve_volumes(mesh, {before.begin(), before.end()}, {});
    EXPECT_GT(report.drift_before, 0.03);
    EXPECT_LT(report.drift, 1e-8);
    EXPECT_EQ(report.regions_off, 0u);
    EXPECT_NEAR(region_volumes(mesh)[1] / before[1], 1, 1e-8);
    test::expect_sound(check(mesh));
}

TEST(PreserveVolume, leaves_free_regions_free) {
    Mesh mesh = test::run(test::ball_volume({21, 21, 21}, 7)).mesh;
    const std::uint64_t same = test::digest(mesh);
    EXPECT_EQ(preserve_volumes(mesh, {std::nullopt, std::nullopt}, {}).rounds, 0u);
    EXPECT_EQ(test::digest(mesh), same);
    const double before = region_volumes(mesh)[1];
    EXPECT_EQ(preserve_volumes(mesh, {std::nullopt, 1.01 * before}, {}).regions_off, 0u);
    EXPECT_NEAR(region_volumes(mesh)[1], 1.01 * before, 1e-6);
}

TEST(PreserveVolume, keeps_all_grains_after_smoothing) {
    test::ArrayVolume volume = test::grain_volume({30, 25, 20}, 12, 5);
    const Reconstruction made = test::run(volume, preserving(test::plain()));
    EXPECT_GT(made.report.preserved.drift_before, 1e-5);
    EXPECT_LT(made.report.preserved.drift, 1e-6);
    const std::vector<double> exact = region_volumes(test::run(volume).mesh), now = region_volumes(made.mesh);
    ASSERT_EQ(now.size(), exact.size());
    for (std::size_t n = 0; n < exact.size(); ++n) EXPECT_NEAR(now[n] / exact[n], 1, 1e-6);
    test::expect_sound(made.report.check);
}

TEST(PreserveVolume, takes_back_what_decimation_changed) {
    test::ArrayVolume volume = test::grain_volume({40, 30, 30}, 12, 6);
    for (std::uint32_t passes : {0u, 20u}) {
        ReconstructOptions options = preserving(test::reduced(0.8));
        options.smooth.filter = SmoothFilter::kTaubin;
        options.smooth.passes = passes;
        const Reconstruction made = test::run(volume, options);
        EXPECT_GT(made.report.preserved.drift_before, 1e-6);
        EXPECT_EQ(made.report.preserved.regions_off, 0u);
        EXPECT_GE(made.report.check.quality.min, 0.1 - 1e-12);
        test::expect_sound(made.report.check);
    }
}

TEST(PreserveVolume, keeps_to_the_box) {
    test::ArrayVolume volume = test::grain_volume({20, 20, 20}, 8, 9);
    Mesh mesh = test::run(volume).mesh;
    const std::vector<double> before = region_volumes(mesh);
    WantedVolumes wanted(before.begin(), before.end());
    wanted[0] = 1.02 * before[0];
    wanted[1].reset();
    const Mesh was = test::run(volume).mesh;
    preserve_volumes(mesh, wanted, {});
    for (std::uint32_t n = 0; n < mesh.vertex_end(); ++n) {
        const VertexId v{n};
        for (int axis = 0; axis < 3; ++axis) {
            if (was[v].sides >> (2 * axis) & 3) {
                EXPECT_EQ(mesh.position(v)[axis], was.position(v)[axis]);
            }
        }
    }
    EXPECT_NEAR(region_volumes(mesh)[0], 1.02 * before[0], 1e-6);
}

}  // namespace
}  // namespace regionmesh
