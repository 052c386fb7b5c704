#include <gtest/gtest.h>

#include "regionmesh/check.h"
#include "support/runs.h"
#include "support/shapes.h"

namespace regionmesh {
namespace {

TEST(Lines, are_measured_along_a_book_with_a_bend) {
    // Three pages of regions 0, 1, 2 hang on a line of two edges, of lengths 1 and 2, that turns by a right angle.
    const Mesh mesh =
        test::shape({{0, 0, 0}, {1, 0, 0}, {1, 2, 0}, {2, -1, 0}, {1, 0, 1}, {1, 0, -1}}, {{{0, 1, 3}, 0, 1},
                                                                                           {{1, 2, 3}, 0, 1},
                                                                                           {{0, 1, 4}, 1, 2},
                                                                                           {{1, 2, 4}, 1, 2},
                                                                                           {{0, 1, 5}, 2, 0},
                                                                                           {{1, 2, 5}, 2, 0}});
    const LineReport report = check(mesh, {}).lines;
    EXPECT_EQ(report.edges, 2u);
    EXPECT_DOUBLE_EQ(report.length, 3);
    EXPECT_DOUBLE_EQ(report.mean_turning_angle, 90);
}

TEST(Lines, on_the_box_do_not_count) {
    const LineReport report = check(test::run(test::TextVolume({{"112", "112"}, {"112", "112"}})).mesh, {}).lines;
    EXPECT_EQ(report.edges, 0u);
    EXPECT_EQ(report.mean_turning_angle, 0);
}

TEST(Lines, turn_less_after_smoothing) {
    test::ArrayVolume volume = test::grain_volume({24, 20, 22}, 10, 3);
    ReconstructOptions options = test::plain();
    const double before = test::run(volume, options).report.check.lines.mean_turning_angle;
    options.smooth = {};
    EXPECT_LT(test::run(volume, options).report.check.lines.mean_turning_angle, 0.5 * before);
}

}  // namespace
}  // namespace regionmesh
