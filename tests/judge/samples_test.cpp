// No sample changes its region while faces are decimated.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "mesh/sample_lines.h"
#include "support/runs.h"

namespace regionmesh {
namespace {

std::uint64_t samples_wrong(test::ArrayVolume& volume, const ReconstructOptions& options) {
    const Reconstruction made = test::run(volume, options);
    test::expect_sound(made.report.check);
    return made.report.samples.value().wrong;
}

TEST(Samples, keep_their_regions_at_any_reduction) {
    test::ArrayVolume volumes[] = {test::noise_volume({9, 8, 10}, 3, 1), test::grain_volume({20, 18, 22}, 9, 3),
                                   test::ball_volume({16, 16, 16}, 5.3)};
    for (test::ArrayVolume& volume : volumes)
        for (const Vec3 spacing : {Vec3{1, 1, 1}, Vec3{0.7, 1.3, 4}})
            for (const double share : {0.5, 0.9, 0.99})
                for (const SmoothFilter filter : {SmoothFilter::kLattice, SmoothFilter::kTaubin}) {
                    volume.lattice().spacing = spacing;
                    ReconstructOptions options{.reduce = share, .background = {}};
                    options.smooth.filter = filter;
                    EXPECT_EQ(samples_wrong(volume, options), 0u);
                    options.placement = PlacementKind::kLindstromTurk;
                    EXPECT_EQ(samples_wrong(volume, options), 0u);
                }
}

TEST(Samples, may_change_where_that_is_asked_for) {
    test::ArrayVolume volume = test::noise_volume({9, 8, 10}, 3, 1);
    EXPECT_GT(samples_wrong(volume, {.reduce = 0.9, .keep_samples = false, .background = {}}), 0u);
}

/// Each sample twice along each axis: the steps of the labels are far apart, and each has tiny faces at its corners.
test::ArrayVolume enlarged(const test::ArrayVolume& volume) {
    const auto [nx, ny, nz] = volume.size();
    std::vector<InputLabel> labels;
    for (std::uint32_t z = 0; z < 2 * nz; ++z)
        for (std::uint32_t y = 0; y < 2 * ny; ++y)
            for (std::uint32_t x = 0; x < 2 * nx; ++x) labels.push_back(volume.at(x / 2, y / 2, z / 2));
    return {{2 * nx, 2 * ny, 2 * nz}, labels};
}

TEST(Samples, of_enlarged_labels_need_not_be_kept_for_a_model_of_few_faces_to_keep_its_shape) {
    test::ArrayVolume volume = enlarged(test::ball_volume({24, 24, 24}, 9.4));
    ReconstructOptions options{.reduce = 0.99, .keep_samples = false};
    const Reconstruction made = test::run(volume, options);
    test::expect_sound(made.report.check);
    EXPECT_EQ(made.report.stopped, StopReason::kTarget);
    const double size = 4.0 / 3 * std::numbers::pi * std::pow(2 * 9.4, 3);
    EXPECT_NEAR(made.report.check.regions.front().volume, size, 0.1 * size);
    EXPECT_GT(made.report.check.quality.min, kUsualQuality);
}

TEST(Samples, keep_their_regions_without_decimation) {
    test::ArrayVolume volume = test::noise_volume({9, 8, 10}, 5, 2);
    EXPECT_EQ(samples_wrong(volume, {.decimate = false, .background = {}}), 0u);
}

TEST(SampleLines, cross_a_triangle_between_two_samples) {
    const SampleLines lines({.size = {4, 4, 4}}, {0, 1, 2});
    const auto crossing = lines.crossing({Vec3{1.5, 0.5, 0.5}, {1.5, 1.5, 0.5}, {1.5, 0.9, 1.5}}, 1, 1);
    ASSERT_TRUE(crossing.has_value());
    EXPECT_TRUE(crossing->is_ahead);
    EXPECT_EQ(crossing->first_beyond, 2u);
    EXPECT_FALSE(lines.crossing({Vec3{1.5, 0.5, 0.5}, {1.5, 1.5, 0.5}, {1.5, 0.9, 1.5}}, 2, 1).has_value());
}

/// Two triangles with a common edge through the line: exactly one is crossed, whatever the axis of the lines.
TEST(SampleLines, cross_one_of_two_triangles_at_an_edge) {
    for (int axis = 0; axis < 3; ++axis) {
        const SampleLines lines({.size = {4, 4, 4}}, {axis, (axis + 1) % 3, (axis + 2) % 3});
        const Vec3 low{1.5, 1, 0.5}, high{1.5, 1, 1.5};
        const bool left = lines.crossing({low, high, Vec3{1.5, 0, 1}}, 1, 1).has_value();
        const bool right = lines.crossing({low, high, Vec3{1.5, 2, 1}}, 1, 1).has_value();
        EXPECT_NE(left, right);
    }
}

TEST(SampleLines, have_samples_on_the_box_inside) {
    const SampleLines lines({.size = {4, 4, 4}}, {0, 1, 2});
    const auto at = [&](double x) {
        return lines.crossing({Vec3{x, 0.5, 0.5}, {x, 1.5, 0.5}, {x, 0.9, 1.5}}, 1, 1).value().first_beyond;
    };
    EXPECT_EQ(at(0), 0u) << "the first sample lies behind the cap";
    EXPECT_EQ(at(3), 4u) << "and the last one before it";
}

}  // namespace
}  // namespace regionmesh
