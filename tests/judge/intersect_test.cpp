#include "judge/verdict/intersect_test.h"

#include <gtest/gtest.h>

#include <cmath>

#include "judge/verdict/verdicts.h"
#include "support/shapes.h"

namespace regionmesh {
namespace {

/// The sheet with something beside it.
Mesh sheet_and(const std::vector<Vec3>& positions, const std::vector<test::ShapeFace>& faces) {
    Mesh mesh = test::edge_in_sheet();
    test::add_shape(mesh, positions, faces);
    return mesh;
}

Mesh sheet_and_octahedron(Vec3 middle, double size) {
    Mesh mesh = test::edge_in_sheet();
    test::add_octahedron(mesh, middle, {size, size, size}, 2, 1);
    return mesh;
}

/// Edge 0-1 of the sheet, merged at `position`.
bool is_blocked(Mesh mesh, Vec3 position) {
    const Promises promises{.min_quality = 0};
    const Judge judge(mesh, promises);
    Change change;
    gather(mesh, VertexId{0}, VertexId{1}, change.star);
    EXPECT_EQ(shape_verdict(judge, change, position), Verdict::kAccepted);
    return verdict_at(judge, change, {position}) == Verdict::kIntersect;
}

constexpr Vec3 kTop{0.5, 0, 1};

TEST(IntersectTest, nothing_is_in_the_way_of_a_sheet_alone) {
    EXPECT_FALSE(is_blocked(test::edge_in_sheet(), {0.5, 0, 0}));
    EXPECT_FALSE(is_blocked(test::edge_in_sheet(), kTop));
    EXPECT_FALSE(is_blocked(test::edge_in_sheet(), {0.5, 0, -1}));
}

TEST(IntersectTest, a_face_through_a_new_face_is) {
    const std::vector<Vec3> wall{{0.5, 0, 0.6}, {0.5, 0.2, 2}, {0.5, -0.2, 2}};
    EXPECT_TRUE(is_blocked(sheet_and(wall, {{{0, 1, 2}, 1, 2}}), kTop));
    EXPECT_FALSE(is_blocked(sheet_and(wall, {{{0, 1, 2}, 1, 2}}), {0.5, 0, 0.5}));
}

TEST(IntersectTest, touching_is_meeting) {
    const std::vector<Vec3> needle{kTop, {0.5, 0.2, 2}, {0.5, -0.2, 2}};
    EXPECT_TRUE(is_blocked(sheet_and(needle, {{{0, 1, 2}, 1, 2}}), kTop));
    EXPECT_FALSE(is_blocked(sheet_and(needle, {{{0, 1, 2}, 1, 2}}), {0.5, 0, std::nextafter(1, 0)}));
}

TEST(IntersectTest, an_island_that_the_star_sweeps_over_is) {
    EXPECT_TRUE(is_blocked(sheet_and_octahedron({0.5, 0.1, 0.4}, 0.05), kTop)) << "no face meets it, before or after";
    EXPECT_FALSE(is_blocked(sheet_and_octahedron({0.5, 0.1, 0.4}, 0.05), {0.5, 0, 0.1})) << "below it";
    EXPECT_FALSE(is_blocked(sheet_and_octahedron({0.5, 0.1, -0.4}, 0.05), kTop)) << "on the other side";
    EXPECT_FALSE(is_blocked(sheet_and_octahedron({3, 0, 0.4}, 0.05), kTop)) << "beside it";
}

TEST(IntersectTest, islands_anywhere_within_the_swept_cone_are) {
    for (double x = -0.6; x < 1.7; x += 0.23)
        for (double y = -0.6; y < 0.7; y += 0.19) {
            // The cone from the top over the hexagon: at height z it is scaled by 1 - z.
            const double z = 0.1, scale = 1 - z;
            const double across = std::abs(y) / scale, along = std::abs(x - 0.5) / scale;
            const bool is_inside = across < 0.95 && along + 0.5 * across < 1.45;
            const bool is_outside = across > 1.05 || along + 0.5 * across > 1.55;
            if (!is_inside && !is_outside) continue;
            EXPECT_EQ(is_blocked(sheet_and_octahedron({x, y, z}, 0.01), kTop), is_inside) << "at " << x << ", " << y;
        }
}

TEST(IntersectTest, a_face_that_hangs_on_the_link_is_only_where_it_crosses) {
    // Vertices 10 and 11 with vertex 5 of the sheet at (-1, 0, 0).
    const auto page = [](Vec3 a, Vec3 b) {
        Mesh mesh = test::edge_in_sheet();
        const VertexId u = mesh.add_vertex(a), v = mesh.add_vertex(b);
        mesh.add_face(VertexId{5}, u, v, 1, 2);
        return mesh;
    };
    EXPECT_FALSE(is_blocked(page({-2, 0.5, 0.5}, {-2, -0.5, 0.5}), kTop)) << "behind";
    EXPECT_FALSE(is_blocked(page({0.5, 0.1, 2}, {0.5, -0.1, 2}), kTop)) << "above";
    EXPECT_TRUE(is_blocked(page({1.5, 0.1, 1.2}, {1.5, -0.1, 1.2}), {0.5, 0, 1.2}))
        << "through the spoke on the far side";
    EXPECT_TRUE(is_blocked(page({2, 0.1, 1}, {2, -0.1, 1}), kTop));
}

TEST(IntersectTest, a_face_on_a_link_edge_is_not) {
    const auto page = [](Vec3 tip) {
        Mesh mesh = test::edge_in_sheet();
        const VertexId t = mesh.add_vertex(tip);
        mesh.add_face(VertexId{4}, VertexId{2}, t, 1, 2);
        return mesh;
    };
    EXPECT_FALSE(is_blocked(page({0, 3, 0}), kTop)) << "the sheet goes on";
    EXPECT_FALSE(is_blocked(page({0, 1, 1}), kTop)) << "a wall";
    EXPECT_FALSE(is_blocked(page({0, -1, 4}), kTop)) << "a roof over it";
}

TEST(IntersectTest, a_flat_star_that_stays_flat_passes_by_islands) {
    EXPECT_FALSE(is_blocked(sheet_and_octahedron({0.5, 0, 0.3}, 0.2), {0.5, 0.1, 0}));
}

}  // namespace
}  // namespace regionmesh
