#include "compare/distance.h"

#include <gtest/gtest.h>

#include <random>

namespace regionmesh {
namespace {

using Corners = std::array<Vec3, 3>;

/// Least value of a convex function on [0, high], by thirds.
template <class Function>
double least(double high, Function&& function) {
    double low = 0;
    for (int n = 0; n < 100; ++n) {
        const double a = low + (high - low) / 3, b = high - (high - low) / 3;
        (function(a) < function(b) ? high : low) = function(a) < function(b) ? b : a;
    }
    return function(0.5 * (low + high));
}

double searched_distance(Vec3 p, const Corners& t) {
    return std::sqrt(least(1, [&](double u) {
        return least(1 - u, [&](double v) { return length2(t[0] + u * (t[1] - t[0]) + v * (t[2] - t[0]) - p); });
    }));
}

double distance(Vec3 p, const Corners& t) { return std::sqrt(squared_distance(p, t)); }

const Corners kRight{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};

TEST(Distance, to_the_inside_an_edge_and_a_corner_of_a_triangle) {
    EXPECT_EQ(distance({0.25, 0.25, 3}, kRight), 3);
    EXPECT_EQ(distance({0.25, 0.25, -3}, kRight), 3);
    EXPECT_EQ(distance({0.5, -4, 3}, kRight), 5) << "nearest is an edge";
    EXPECT_EQ(distance({-3, -4, 12}, kRight), 13) << "nearest is a corner";
    EXPECT_EQ(distance({5, -3, 0}, kRight), 5) << "beyond two edges, nearest is the corner between";
    EXPECT_EQ(distance({0.5, 0.5, 0}, kRight), 0);
}

TEST(Distance, is_the_least_over_all_points_of_a_triangle) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit(-1, 1);
    const auto any = [&] { return Vec3{unit(random), unit(random), unit(random)}; };
    for (int n = 0; n < 300; ++n) {
        const Corners t{any(), any(), any()};
        const Vec3 p = 2 * any();
        EXPECT_NEAR(distance(p, t), searched_distance(p, t), 1e-7) << n;
    }
}

TEST(Distance, does_not_depend_on_the_order_of_corners) {
    const Corners t{{{0.3, 1, 2}, {4, 0, 1}, {2, 2, 5}}};
    for (const Vec3 p : {Vec3{1, 2, 9}, Vec3{-3, 0, 1}, Vec3{2, 1, 2}, Vec3{5, -5, 0}})
        for (const Corners& other : {Corners{t[1], t[2], t[0]}, Corners{t[2], t[1], t[0]}})
            EXPECT_NEAR(distance(p, t), distance(p, other), 1e-14);
}

TEST(Distance, of_triangles_without_area) {
    const Corners segment{{{0, 0, 0}, {1, 0, 0}, {3, 0, 0}}}, point{{{1, 2, 3}, {1, 2, 3}, {1, 2, 3}}};
    EXPECT_EQ(distance({2, 4, 3}, segment), 5);
    EXPECT_EQ(distance({6, 0, 4}, segment), 5);
    EXPECT_EQ(distance({1, 2, 5}, point), 2);
    const Corners sliver{{{0, 0, 0}, {1, 1e-12, 0}, {2, 0, 0}}};
    EXPECT_NEAR(distance({1, 5e-13, 7}, sliver), 7, 1e-11);
}

TEST(Distance, is_only_found_where_it_is_below_the_bound) {
    EXPECT_EQ(squared_distance({0.25, 0.25, 3}, kRight, 9.5), 9);
    EXPECT_GE(squared_distance({0.25, 0.25, 3}, kRight, 8.5), 8.5);
}

TEST(Distance, to_a_segment) {
    EXPECT_EQ(squared_distance({1, 3, 4}, {0, 0, 0}, {2, 0, 0}), 25);
    EXPECT_EQ(squared_distance({-3, 4, 0}, {0, 0, 0}, {2, 0, 0}), 25);
    EXPECT_EQ(squared_distance({5, 4, 0}, {0, 0, 0}, {2, 0, 0}), 25);
    EXPECT_EQ(squared_distance({5, 4, 0}, {2, 0, 0}, {2, 0, 0}), 25) << "a point";
}

}  // namespace
}  // namespace regionmesh
