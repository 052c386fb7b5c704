#include "base/exact_predicates.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/hash.h"

namespace regionmesh {
namespace {

constexpr Triangle kBase{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};

Triangle moved(const Triangle& t, Vec3 step) { return {t.a + step, t.b + step, t.c + step}; }

/// The answer must not depend on which corner is named first, nor on which triangle.
void expect_meet(const Triangle& s, const Triangle& t, bool expected) {
    const Triangle turned{s.b, s.c, s.a}, flipped{t.a, t.c, t.b};
    EXPECT_EQ(meet(s, t), expected);
    EXPECT_EQ(meet(t, s), expected);
    EXPECT_EQ(meet(turned, flipped), expected);
    EXPECT_EQ(meet(flipped, turned), expected);
}

TEST(Orientation, is_positive_on_the_side_of_the_normal) {
    EXPECT_EQ(orientation({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}), 1);
    EXPECT_EQ(orientation({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}), -1);
    EXPECT_EQ(orientation({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {7, 9, 0}), 0);
}

TEST(Orientation, sees_the_last_bit) {
    const Vec3 a{0.1, 0.1, 0.1}, b{0.2, 0.3, 0.4}, c{0.5, 0.4, 0.2};
    const double z = std::nextafter(1e-300, 1);
    EXPECT_EQ(orientation({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.3, 0.3, z}), 1);
    EXPECT_EQ(orientation({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.3, 0.3, -z}), -1);
    EXPECT_EQ(orientation(a, b, c, a), 0);
    EXPECT_EQ(orientation(a, b, c, b), 0);
    // The middle of a and b is rounded: the exact answer is whatever it is, but both orders must agree.
    const Vec3 middle = 0.5 * (a + b);
    EXPECT_EQ(orientation(a, b, c, middle), -orientation(b, a, c, middle));
}

TEST(Orientation, agrees_with_the_exact_one_on_near_flat_input) {
    std::uint64_t state = 5;
    SCOPED_TRACE("seed 5");
    const auto unit = [&] { return static_cast<double>((state = mix64(state)) >> 11) * 0x1p-53; };
    for (int n = 0; n < 2000; ++n) {
        const Vec3 a{unit(), unit(), unit()}, b{unit(), unit(), unit()}, c{unit(), unit(), unit()};
        const double s = unit(), t = unit();
        const Vec3 d = a + s * (b - a) + t * (c - a);
        EXPECT_EQ(orientation(a, b, c, d), exact_orientation(a, b, c, d));
        EXPECT_EQ(orientation(a, b, c, d), -orientation(a, c, b, d));
    }
}

TEST(IsDegenerate, means_on_one_line_exactly) {
    EXPECT_TRUE(is_degenerate({{0, 0, 0}, {1, 1, 1}, {3, 3, 3}}));
    EXPECT_TRUE(is_degenerate({{0, 0, 0}, {0, 0, 0}, {3, 1, 2}}));
    EXPECT_FALSE(is_degenerate({{0, 0, 0}, {1, 1, 1}, {3, 3, std::nextafter(3, 4)}}));
    EXPECT_FALSE(is_degenerate({{0, 0, 0}, {1e200, 0, 0}, {0, 1e200, 0}}));
    for (const double nowhere : {std::nan(""), HUGE_VAL})
        EXPECT_TRUE(is_degenerate({{0, 0, 0}, {1, 0, 0}, {0, nowhere, 0}}));
}

TEST(Meet, crossing_and_apart) {
    expect_meet(kBase, {{1, 1, -1}, {1, 1, 1}, {9, 9, 1}}, true);
    expect_meet(kBase, {{1, 1, 1}, {1, 2, 1}, {2, 1, 2}}, false);
    expect_meet(kBase, {{3, 3, -1}, {3, 3, 1}, {9, 9, 1}}, false);
    expect_meet(kBase, {{-1, 1, -1}, {-1, 1, 1}, {5, 1, 0}}, true);
}

TEST(Meet, touching_counts) {
    expect_meet(kBase, {{1, 1, 0}, {1, 1, 1}, {2, 2, 1}}, true);     // a corner on the face
    expect_meet(kBase, {{2, 0, 0}, {2, -1, 1}, {2, -1, -1}}, true);  // a corner on an edge
    expect_meet(kBase, {{4, 0, 0}, {5, 0, 1}, {5, 1, 1}}, true);     // a corner on a corner
    expect_meet(kBase, {{2, -1, -1}, {2, 1, 1}, {9, -9, 0}}, true);  // an edge through an edge
    expect_meet(kBase, {{std::nextafter(4, 5), 0, 0}, {5, 0, 1}, {5, 1, 1}}, false);
}

TEST(Meet, in_one_plane) {
    expect_meet(kBase, moved(kBase, {1, 1, 0}), true);
    expect_meet(kBase, moved(kBase, {5, 0, 0}), false);
    expect_meet(kBase, {{1, 1, 0}, {1.5, 1, 0}, {1, 1.5, 0}}, true);  // one inside the other
    expect_meet(kBase, moved(kBase, {4, 0, 0}), true);                // corner to corner
    expect_meet(kBase, {{2, 2, 0}, {4, 4, 0}, {4, 2, 0}}, true);      // a corner on the slanted edge
    expect_meet(kBase, {{2, std::nextafter(2, 3), 0}, {4, 4, 0}, {4, 2.5, 0}}, false);
    expect_meet(kBase, moved(kBase, {0, 0, std::nextafter(0, 1)}), false);
}

TEST(MeetBeyondVertex, pages_that_only_share_their_vertex_do_not) {
    const Vec3 p{0, 0, 0};
    EXPECT_FALSE(meet_beyond_vertex(p, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}));
    EXPECT_FALSE(meet_beyond_vertex(p, {1, 0, 0}, {0, 1, 0}, {1, 0, 1}, {0, 1, 1}));
    EXPECT_FALSE(meet_beyond_vertex(p, {1, 0, 0}, {0, 1, 0}, {1, -1, 1}, {1, -1, -1}));
}

TEST(MeetBeyondVertex, pages_that_cross_or_overlap_do) {
    const Vec3 p{0, 0, 0};
    EXPECT_TRUE(meet_beyond_vertex(p, {1, 0, 0}, {0, 1, 0}, {1, 1, 1}, {1, 1, -1}));
    EXPECT_TRUE(meet_beyond_vertex(p, {1, 0, 0}, {0, 1, 0}, {9, 9, 1}, {9, 9, -1})) << "the other page is larger";
    EXPECT_TRUE(meet_beyond_vertex(p, {1, 0, 0}, {0, 1, 0}, {2, 1, 0}, {1, 2, 0}))
        << "coplanar, one within the angle of the other";
    EXPECT_TRUE(meet_beyond_vertex(p, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {-1, 1, 0})) << "coplanar, the angles overlap";
}

TEST(MeetBeyondVertex, touching_along_a_ray_does) {
    const Vec3 p{0, 0, 0};
    EXPECT_TRUE(meet_beyond_vertex(p, {1, 0, 0}, {0, 1, 0}, {2, 0, 0}, {1, 0, 1})) << "along an edge";
    EXPECT_TRUE(meet_beyond_vertex(p, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {1, 1, 1})) << "an edge within the page";
    EXPECT_TRUE(meet_beyond_vertex(p, {1, 0, 0}, {0, 1, 0}, {2, 0, 0}, {1, -1, 0}))
        << "coplanar side by side, a common ray";
}

TEST(MeetBeyondVertex, coplanar_pages_apart_do_not) {
    const Vec3 p{1, 1, 1};
    EXPECT_FALSE(meet_beyond_vertex(p, {2, 1, 1}, {1, 2, 1}, {0, 1, 1}, {1, 0, 1}));
    EXPECT_FALSE(meet_beyond_vertex(p, {2, 1, 1}, {1, 2, 1}, {2, 0.999, 1}, {1, 0, 1}));
}

TEST(MeetBeyondEdge, only_folded_flat_onto_each_other) {
    const Vec3 p{0, 0, 0}, q{1, 0, 0};
    EXPECT_TRUE(meet_beyond_edge(p, q, {0, 1, 0}, {1, 2, 0}));
    EXPECT_FALSE(meet_beyond_edge(p, q, {0, 1, 0}, {0, -1, 0})) << "flat, on both sides";
    EXPECT_FALSE(meet_beyond_edge(p, q, {0, 1, 0}, {0, 0, 1}));
    EXPECT_FALSE(meet_beyond_edge(p, q, {0, 1, 0}, {0, 1, std::nextafter(0, 1)})) << "a wedge as thin as can be";
}

}  // namespace
}  // namespace regionmesh
