#include "volume/exact_grid.h"

#include <gtest/gtest.h>

#include <limits>

#include "support/random.h"

namespace regionmesh {
namespace {

/// Rounding-free sums in twice the digits.
bool is_exact(const std::vector<double>& of, double mean) {
    long double sum = 0;
    for (double x : of) sum += static_cast<long double>(x) - mean;
    return sum == 0;
}

TEST(ExactGrid, means_of_two_three_and_four_points_are_exact) {
    test::Random random(1);
    for (const double size : {1.0, 3e-7, 450000.0, 1e12}) {
        std::vector<Vec3> points(400);
        for (Vec3& p : points) p = {size * random.unit(), size * (random.unit() - 0.5), size * (random.unit() + 10)};
        move_to_exact_grid(points);
        for (std::size_t n = 0; n + 3 < points.size(); ++n)
            for (int axis = 0; axis < 3; ++axis) {
                const double a = points[n][axis], b = points[n + 1][axis], c = points[n + 2][axis],
                             d = points[n + 3][axis];
                EXPECT_TRUE(is_exact({a, b}, a + (b - a) / 2));
                EXPECT_TRUE(is_exact({a, b, c}, a + ((b - a) + (c - a)) / 3));
                EXPECT_TRUE(is_exact({a, b, c, d}, a + ((b - a) + (c - a) + (d - a)) / 4));
            }
    }
}

TEST(ExactGrid, points_hardly_move_and_keep_their_order) {
    test::Random random(2);
    std::vector<Vec3> points(1000);
    for (Vec3& p : points) p = {random.unit(), std::floor(10 * random.unit()), -1e6 * random.unit()};
    std::vector<Vec3> moved = points;
    move_to_exact_grid(moved);
    for (std::size_t n = 0; n < points.size(); ++n)
        for (int axis = 0; axis < 3; ++axis) {
            EXPECT_NEAR(moved[n][axis], points[n][axis], 3e-15 * (axis == 0 ? 1 : axis == 1 ? 16 : 1048576));
            for (std::size_t m = 0; m < n; ++m) {
                if (points[m][axis] == points[n][axis]) {
                    EXPECT_EQ(moved[m][axis], moved[n][axis]);
                } else {
                    EXPECT_EQ(moved[m][axis] <= moved[n][axis], points[m][axis] <= points[n][axis]);
                }
            }
        }
}

TEST(ExactGrid, zeros_and_extremes_stay_finite) {
    const double most = std::numeric_limits<double>::max(), least = std::numeric_limits<double>::denorm_min();
    std::vector<Vec3> points{{0, most, least}, {0, -most / 3, 0}, {0, 1, 3 * least}};
    move_to_exact_grid(points);
    for (const Vec3& p : points)
        for (int axis = 0; axis < 3; ++axis) EXPECT_TRUE(std::isfinite(p[axis]));
    EXPECT_EQ(points[0].x, 0);
}

TEST(ExactGrid, factors_become_powers_of_two) {
    EXPECT_EQ(nearest_power_of_two(1), 1);
    EXPECT_EQ(nearest_power_of_two(100), 128);
    EXPECT_EQ(nearest_power_of_two(5), 4);
    EXPECT_EQ(nearest_power_of_two(0.1), 0.125);
}

}  // namespace
}  // namespace regionmesh
