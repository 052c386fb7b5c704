#include "mesh/exact_ray.h"

#include <gtest/gtest.h>

#include "support/random.h"
#include "support/shapes.h"

namespace regionmesh {
namespace {

/// How often the surface goes round the point.
std::optional<int> times_round(const Mesh& mesh, Vec3 point) {
    const SortedFaceTree tree(mesh, 1);
    const auto passed = ExactRay(mesh, tree).faces_passed(point, [](FaceId) { return true; });
    if (!passed) return std::nullopt;
    int sum = 0;
    for (const FacePassed& face : *passed) sum += face.leaves_first ? 1 : -1;
    return sum;
}

TEST(ExactRay, point_is_inside_by_any_margin) {
    const Mesh mesh = test::octahedron();
    EXPECT_EQ(times_round(mesh, {}), 1);
    EXPECT_EQ(times_round(mesh, {1 - 1e-15, 0, 0}), 1);
    EXPECT_EQ(times_round(mesh, {1 + 1e-15, 0, 0}), 0);
    EXPECT_EQ(times_round(mesh, {0, 0, -3}), 0);
}

TEST(ExactRay, point_in_line_with_corners_finds_another_line) {
    const Mesh mesh = test::octahedron();
    for (int axis = 0; axis < 3; ++axis) {
        Vec3 p;
        p[axis] = 2;
        EXPECT_EQ(times_round(mesh, p), 0);
        p[axis] = -0.5;
        EXPECT_EQ(times_round(mesh, p), 1);
    }
}

TEST(ExactRay, nothing_is_said_of_a_point_on_a_face) {
    EXPECT_FALSE(times_round(test::octahedron(), {1, 0, 0}));
    EXPECT_FALSE(times_round(test::octahedron(), {0.5, 0.25, 0.25}));
}

TEST(ExactRay, random_points_lie_where_the_formula_says) {
    const Mesh mesh = test::octahedron();
    test::Random random(7);
    for (int n = 0; n < 2000; ++n) {
        const Vec3 p = random.point(1.2);
        const double size = std::abs(p.x) + std::abs(p.y) + std::abs(p.z);
        if (std::abs(size - 1) < 1e-9) continue;
        EXPECT_EQ(times_round(mesh, p), size < 1 ? 1 : 0);
    }
}

}  // namespace
}  // namespace regionmesh
