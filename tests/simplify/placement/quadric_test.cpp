#include "simplify/placement/quadric.h"

#include <gtest/gtest.h>

namespace regionmesh {
namespace {

/// Weight 2 times the squared distance to z = 1, and weight 3 times that to the plane x + y = 0.
Quadric two_planes() {
    Quadric q;
    q.add_plane({0, 0, 1}, -1, 2);
    const double h = std::sqrt(0.5);
    q.add_plane({h, h, 0}, 0, 3);
    return q;
}

TEST(Quadric, is_the_sum_of_weighted_squared_distances) {
    const Quadric q = two_planes();
    EXPECT_NEAR(q.at({0, 0, 1}), 0, 1e-15);
    EXPECT_NEAR(q.at({0, 0, 4}), 2 * 9, 1e-12);
    EXPECT_NEAR(q.at({1, 1, 1}), 3 * 2, 1e-12);
    EXPECT_NEAR(q.at({1, 1, 3}), 2 * 4 + 3 * 2, 1e-12);
    EXPECT_NEAR(q.weight(), 5, 1e-12);
}

TEST(Quadric, sums_are_sums_of_values) {
    Quadric q = two_planes();
    Quadric other;
    other.add_plane({1, 0, 0}, 5, 1);
    q += other;
    const Vec3 x{0.3, -2, 7};
    EXPECT_NEAR(q.at(x), two_planes().at(x) + other.at(x), 1e-9);
}

TEST(Quadric, seen_from_elsewhere_has_the_same_values) {
    const Quadric q = two_planes();
    const Vec3 shift{10, -3, 2.5};
    for (const Vec3 x : {Vec3{0, 0, 0}, Vec3{1, 2, 3}, Vec3{-4, 0.5, 9}})
        EXPECT_NEAR(q.seen_from(shift).at(x - shift), q.at(x), 1e-9);
}

TEST(PackedQuadric, keeps_single_precision) {
    const Quadric back = PackedQuadric(two_planes()).unpack();
    EXPECT_NEAR(back.at({1, 2, 3}), two_planes().at({1, 2, 3}), 1e-4);
    EXPECT_EQ(sizeof(PackedQuadric), 40u);
}

}  // namespace
}  // namespace regionmesh
