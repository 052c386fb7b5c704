#include "simplify/placement/least_cost.h"

#include <gtest/gtest.h>

#include <vector>

namespace regionmesh {
namespace {

/// The planes of a quadric, each through a point.
struct Plane {
    Vec3 normal, through;
};

PackedQuadric quadric_of(const std::vector<Plane>& planes, Vec3 seen_from) {
    Quadric q;
    for (const Plane& plane : planes) q.add_plane(plane.normal, -dot(plane.normal, plane.through - seen_from), 1);
    return PackedQuadric(q);
}

TEST(LeastCost, finds_the_corner_of_three_planes) {
    const Vec3 goes{1, 0.1, 0}, stays{0, 0.2, 1}, corner{1, 2, 3};
    const PackedQuadric a = quadric_of({{{1, 0, 0}, corner}, {{0, 1, 0}, corner}}, goes);
    const PackedQuadric b = quadric_of({{{0, 0, 1}, corner}}, stays);
    const LeastCost placed = least_cost({goes, stays, a, b, 0});
    EXPECT_NEAR(length(placed.position - corner), 0, 0.02);
    EXPECT_NEAR(placed.cost, 0, 0.001);
}

TEST(LeastCost, on_a_flat_star_is_the_middle_of_the_edge) {
    const Vec3 goes{1, 0, 0}, stays{3, 2, 0};
    const PackedQuadric a = quadric_of({{{0, 0, 1}, goes}}, goes), b = quadric_of({{{0, 0, 1}, stays}}, stays);
    const LeastCost placed = least_cost({goes, stays, a, b, 0});
    EXPECT_NEAR(length(placed.position - Vec3{2, 1, 0}), 0, 1e-6);
    EXPECT_NEAR(placed.cost, 0, 1e-12);
}

TEST(LeastCost, keeps_the_coordinates_of_box_sides_to_the_bit) {
    const Vec3 goes{0.1, 1.0 / 3, 0.7}, stays{0.3, 2.0 / 3, 0.9};
    const std::vector<Plane> planes{{{1, 0, 0}, {9, 9, 9}}, {{0, 1, 0}, {9, 9, 9}}, {{0, 0, 1}, {9, 9, 9}}};
    const PackedQuadric a = quadric_of(planes, goes), b = quadric_of(planes, stays);
    for (SideSet sides = 0; sides < 64; ++sides) {
        const LeastCost placed = least_cost({goes, stays, a, b, sides});
        for (int axis = 0; axis < 3; ++axis) {
            const bool is_locked = sides >> (2 * axis) & 3;
            EXPECT_EQ(placed.position[axis] == stays[axis], is_locked);
            EXPECT_NEAR(placed.position[axis], is_locked ? stays[axis] : 9, 0.05);
        }
    }
}

TEST(LeastCost, cost_is_that_of_its_place) {
    const Vec3 goes{0, 0, 0}, stays{1, 0, 0};
    const PackedQuadric a = quadric_of({{{0, 0, 1}, {0, 0, 1}}}, goes),
                        b = quadric_of({{{0, 0, 1}, {0, 0, -1}}}, stays);
    const EdgeEnds edge{goes, stays, a, b, 0};
    const LeastCost placed = least_cost(edge);
    EXPECT_NEAR(placed.cost, 2, 1e-5) << "in the middle between two planes one away";
    EXPECT_NEAR(cost_at(edge, placed.position), placed.cost, 1e-5);
    EXPECT_NEAR(cost_at(edge, {0.3, 5, 1}), 4, 1e-5);
}

TEST(LeastCost, never_costs_less_than_nothing) {
    const Vec3 goes{1e6, 1e6, 1e6}, stays{1e6 + 1, 1e6, 1e6};
    const PackedQuadric a = quadric_of({{{0, 0, 1}, goes}}, goes), b = quadric_of({{{0, 0, 1}, stays}}, stays);
    EXPECT_GE(least_cost({goes, stays, a, b, 0}).cost, 0);
    EXPECT_GE(least_cost({goes, stays, PackedQuadric(), PackedQuadric(), 0}).cost, 0) << "no plane at all";
}

}  // namespace
}  // namespace regionmesh
