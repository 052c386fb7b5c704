// The range of spacing and origin that limits.h states: certificates hold at its ends.
#include <gmock/gmock.h>

#include "regionmesh/error.h"
#include "regionmesh/limits.h"
#include "support/runs.h"

namespace regionmesh {
namespace {

constexpr SmoothFilter kFilters[] = {SmoothFilter::kLattice, SmoothFilter::kTaubin, SmoothFilter::kLaplacian,
                                     SmoothFilter::kNifpms};

void expect_sound_model(Vec3 spacing, Vec3 origin, double most_left = 0.5) {
    test::ArrayVolume volume = test::grain_volume({9, 8, 7}, 6, 20260719);
    volume.spaced(spacing);
    volume.lattice().origin = origin;
    for (const SmoothFilter filter : kFilters) {
        SCOPED_TRACE(testing::Message() << "filter " << static_cast<int>(filter) << ", spacing " << spacing.x << " "
                                        << spacing.y << " " << spacing.z << ", origin " << origin.x);
        const Reconstruction made =
            test::run(volume, {.reduce = 0.7, .smooth = {.filter = filter, .passes = 5}, .background = {}});
        test::expect_sound(made.report.check);
        EXPECT_GT(made.report.final_faces, 0u);
        EXPECT_LT(made.report.final_faces, made.report.initial_faces * most_left);
    }
}

TEST(Range, models_are_sound_at_the_smallest_and_the_largest_spacing) {
    for (const double spacing : {kLeastLength, 1e-6, 1e4, kMostLength})
        expect_sound_model({spacing, spacing, spacing}, {});
}

TEST(Range, models_are_sound_at_the_farthest_origin) {
    const double far = kMostSpacings - 9;
    expect_sound_model({1, 1, 1}, {far, -far, far});
    expect_sound_model({kLeastLength, kLeastLength, kLeastLength}, {far * kLeastLength, 0, 0});
}

// Needles leave few collapses that keep their quality.
TEST(Range, models_are_sound_at_very_different_spacings) { expect_sound_model({1, 1000, 1e6}, {}, 0.9); }

TEST(Range, models_are_sound_where_spacings_differ_by_more_than_coordinates_hold) {
    for (const Vec3 spacing : {Vec3{1e-4, 1e6, 1e6}, {1e-4, 1e-4, 4e6}, {1e-6, 1e4, 1}})
        expect_sound_model(spacing, {}, 1.1);
}

TEST(Range, beyond_it_a_reader_of_ones_own_is_refused) {
    for (const double spacing : {1e-170, 1e-90, 1e103, 1e160}) {
        test::ArrayVolume volume = test::ball_volume({5, 5, 5}, 2);
        volume.spaced({spacing, spacing, spacing});
        EXPECT_THROW(test::run(volume, {.smooth = {.filter = SmoothFilter::kNifpms, .passes = 1}}), Error);
    }
}

}  // namespace
}  // namespace regionmesh
