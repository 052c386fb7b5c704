#include "judge/verdict/verdicts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/triangle.h"
#include "mesh/strata.h"
#include "support/shapes.h"

namespace regionmesh {
namespace {

using test::halved_octahedron;
using test::shape;
using test::ShapeFace;

Verdict topology_of(Mesh& mesh, std::uint32_t goes, std::uint32_t stays) {
    count_labels(mesh);
    const Promises promises;
    const Judge judge(mesh, promises, {.sees_others = false});
    Change change;
    gather(mesh, VertexId{goes}, VertexId{stays}, change.star);
    return topology_verdict(judge, change);
}

struct ShapeResult {
    Verdict verdict;
    double worst_quality3;
};

Verdict topology_of(Mesh&& mesh, std::uint32_t goes, std::uint32_t stays) { return topology_of(mesh, goes, stays); }

/// Collapses edge 0-1.
ShapeResult shape_of(Mesh& mesh, Vec3 position, const Promises& promises = {}) {
    const Judge judge(mesh, promises, {.sees_others = false});
    Change change;
    gather(mesh, VertexId{0}, VertexId{1}, change.star);
    const Verdict verdict = verdict_at(judge, change, {position});
    return {verdict, change.worst_quality3};
}

ShapeResult shape_of(Mesh&& mesh, Vec3 position, const Promises& promises = {}) {
    return shape_of(mesh, position, promises);
}

/// A triangle 0 1 2 between regions 0 and 1, and on each side a roof over three more vertices: no two corners have a
/// common neighbour but the apexes of their edge.
Mesh triangle_of_lines() {
    std::vector<Vec3> p{{0, 0, 0}, {4, 0, 0}, {2, 4, 0}};
    for (double z : {1.0, -1.0})
        for (Vec3 q : {Vec3{2, 0.2, z}, Vec3{2.9, 1.9, z}, Vec3{1.1, 1.9, z}}) p.push_back(q);
    std::vector<ShapeFace> faces{{{0, 1, 2}, 0, 1}};
    for (std::uint32_t roof = 0; roof < 2; ++roof) {
        const std::uint32_t m = 3 + 3 * roof;
        const Label inside = roof ? 0 : 1;
        for (std::uint32_t n = 0; n < 3; ++n) {
            const std::uint32_t next = (n + 1) % 3;
            const std::array<std::uint32_t, 3> side{n, next, m + n}, corner{next, m + next, m + n};
            for (auto v : {side, corner}) faces.push_back({roof ? std::array{v[0], v[2], v[1]} : v, inside, 2});
        }
        faces.push_back({roof ? std::array{m, m + 2, m + 1} : std::array{m, m + 1, m + 2}, inside, 2});
    }
    return shape(p, faces);
}

TEST(Gather, collects_the_star_of_the_edge) {
    EdgeStar star;
    gather(test::edge_in_sheet(), VertexId{0}, VertexId{1}, star);
    EXPECT_EQ(star.dead.size(), 2u);
    EXPECT_EQ(star.faces.size(), 8u);
    EXPECT_EQ(star.link.size(), 8u);
    ASSERT_EQ(star.apexes.size(), 2u);
    EXPECT_EQ(index(star.apexes[0]) + index(star.apexes[1]), 5u);
}

TEST(TopologyVerdict, accepts_an_edge_within_an_interface) {
    EXPECT_EQ(topology_of(test::edge_in_sheet(), 0, 1), Verdict::kAccepted);
    EXPECT_EQ(topology_of(test::octahedron(), 0, 2), Verdict::kAccepted);
}

TEST(TopologyVerdict, an_interface_may_go_into_a_line_but_no_line_into_an_interface) {
    EXPECT_EQ(topology_of(halved_octahedron(), 5, 1), Verdict::kAccepted);
    EXPECT_EQ(topology_of(halved_octahedron(), 1, 5), Verdict::kStrata);
    EXPECT_EQ(topology_of(halved_octahedron(), 1, 6), Verdict::kStrata);
}

TEST(TopologyVerdict, a_line_may_be_collapsed_along_itself) {
    EXPECT_EQ(topology_of(halved_octahedron(), 1, 3), Verdict::kAccepted);
}

TEST(TopologyVerdict, an_edge_between_two_lines_within_an_interface_may_not) {
    // The membrane without its middle: 0-1 crosses it from line to line.
    Mesh mesh = shape({{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}}, {{{0, 1, 3}, 0, 1},
                                                                                              {{1, 0, 2}, 0, 1},
                                                                                              {{1, 3, 5}, 1, 2},
                                                                                              {{3, 0, 5}, 1, 2},
                                                                                              {{0, 2, 5}, 1, 2},
                                                                                              {{2, 1, 5}, 1, 2},
                                                                                              {{3, 1, 4}, 0, 2},
                                                                                              {{0, 3, 4}, 0, 2},
                                                                                              {{2, 0, 4}, 0, 2},
                                                                                              {{1, 2, 4}, 0, 2}});
    EXPECT_EQ(topology_of(mesh, 0, 1), Verdict::kStrata);
}

TEST(TopologyVerdict, a_tetrahedron_may_not_be_collapsed) {
    EXPECT_EQ(topology_of(shape(test::kTetrahedronCorners, test::tetrahedron_faces()), 0, 1), Verdict::kLink);
}

TEST(TopologyVerdict, no_vertex_loses_its_last_face) {
    Mesh mesh = shape({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0}, {2, 1, 0}},
                      {{{0, 1, 2}}, {{0, 2, 3}}, {{1, 4, 5}}, {{1, 5, 2}}});
    EXPECT_EQ(topology_of(mesh, 0, 2), Verdict::kLink) << "3 has no other face";
}

TEST(TopologyVerdict, a_neck_may_not_be_collapsed) {
    // Two tetrahedra on the hollow triangle 0 1 2.
    Mesh mesh = shape({{0, 0, 0}, {2, 0, 0}, {1, 2, 0}, {1, 1, 1}, {1, 1, -1}},
                      {{{0, 1, 3}}, {{1, 2, 3}}, {{2, 0, 3}}, {{1, 0, 4}}, {{2, 1, 4}}, {{0, 2, 4}}});
    for (auto [u, v] : {std::pair{0u, 1u}, {1u, 2u}, {2u, 0u}}) EXPECT_EQ(topology_of(mesh, u, v), Verdict::kLink);
    EXPECT_EQ(topology_of(mesh, 3, 0), Verdict::kAccepted);
}

TEST(TopologyVerdict, a_triangle_of_lines_may_not_be_collapsed) {
    for (auto [u, v] : {std::pair{0u, 1u}, {1u, 2u}, {2u, 0u}, {1u, 0u}})
        EXPECT_EQ(topology_of(triangle_of_lines(), u, v), Verdict::kLink);
    EXPECT_EQ(topology_of(triangle_of_lines(), 3, 0), Verdict::kAccepted) << "only the lines are in the way";
}

TEST(ShapeVerdict, accepts_the_middle_of_a_flat_edge) {
    const ShapeResult result = shape_of(test::edge_in_sheet(), {0.5, 0, 0});
    EXPECT_EQ(result.verdict, Verdict::kAccepted);
    EXPECT_GT(result.worst_quality3, 0.2 * 0.2 * 0.2);
}

TEST(ShapeVerdict, fold_when_a_face_turns_over) {
    EXPECT_EQ(shape_of(test::edge_in_sheet(), {0.5, 1.1, 0}).verdict, Verdict::kFold);
    EXPECT_EQ(shape_of(test::edge_in_sheet(), {0.5, 0, 9}).verdict, Verdict::kFold) << "by nearly a right angle";
    EXPECT_EQ(shape_of(test::edge_in_sheet(), {0.5, 1, 0}).verdict, Verdict::kFold) << "a face without area";
}

/// A pyramid whose tip is cut off: 0 1 2 at the tip, 3 4 5 at the base. A needle leads down from each edge of the tip.
Mesh cut_tip(double tip) {
    std::vector<Vec3> corners;
    for (int n = 0; n < 6; ++n) {
        const double size = n < 3 ? tip : 1, angle = (n < 3 ? 2 * n : 2 * n - 5) * std::numbers::pi / 3;
        corners.push_back({size * std::cos(angle), size * std::sin(angle), n < 3 ? 0.6 : 0});
    }
    return shape(
        corners,
        {{{0, 1, 2}}, {{1, 0, 3}}, {{2, 1, 4}}, {{0, 2, 5}}, {{1, 3, 4}}, {{2, 4, 5}}, {{0, 5, 3}}, {{5, 4, 3}}});
}

TEST(ShapeVerdict, needles_may_get_a_little_longer_where_they_get_fewer) {
    Mesh mesh = cut_tip(0.01);
    const auto p = mesh.corners(FaceId{2});
    const double before = quality_terms(p[0], p[1], p[2]).cube();
    const Vec3 middle = 0.5 * (mesh.position(VertexId{0}) + mesh.position(VertexId{1})),
               other = mesh.position(VertexId{2});
    const ShapeResult result = shape_of(mesh, middle);
    EXPECT_EQ(result.verdict, Verdict::kAccepted);
    EXPECT_LT(result.worst_quality3, before);
    // Needles of half the quality.
    EXPECT_EQ(shape_of(mesh, middle + 0.7 * (other - middle)).verdict, Verdict::kQuality);
    // No needle was below the bound.
    EXPECT_EQ(shape_of(mesh, middle, {.min_quality = 0.99 * std::cbrt(before)}).verdict, Verdict::kQuality);
}

TEST(ShapeVerdict, needles_far_below_the_bound_may_not_get_longer) {
    Mesh mesh = cut_tip(0.001);  // the quality of its needles falls to 0.025
    const Vec3 middle = 0.5 * (mesh.position(VertexId{0}) + mesh.position(VertexId{1}));
    EXPECT_EQ(shape_of(mesh, middle, {.min_quality = 0.1}).verdict, Verdict::kQuality);
    EXPECT_EQ(shape_of(mesh, middle, {.min_quality = 0.05}).verdict, Verdict::kAccepted);
}

TEST(ShapeVerdict, quality_when_a_face_gets_thin) {
    EXPECT_EQ(shape_of(test::edge_in_sheet(), {0.5, 0.97, 0}).verdict, Verdict::kQuality);
    EXPECT_EQ(shape_of(test::edge_in_sheet(), {0.5, 0.97, 0}, {.min_quality = 0}).verdict, Verdict::kAccepted);
}

TEST(ShapeVerdict, a_bad_face_may_get_better) {
    Mesh mesh = test::edge_in_sheet();
    mesh[VertexId{0}].position = {0.45, 0.98, 0};
    mesh[VertexId{1}].position = {0.55, 0.98, 0};
    EXPECT_EQ(shape_of(mesh, {0.5, 0.96, 0}).verdict, Verdict::kAccepted) << "below the bound, but better";
    EXPECT_EQ(shape_of(mesh, {0.2, 0.985, 0}).verdict, Verdict::kQuality);
}

/// Two pages that hang down from a ridge along x, 0-1 its middle edge, 5.5 degrees apart.
Mesh ridge() {
    std::vector<Vec3> p{{0, 0, 0}, {1, 0, 0}, {-1, 0, 0}, {2, 0, 0}};
    for (double y : {0.048, -0.048})
        for (double x : {-0.5, 0.5, 1.5}) p.push_back({x, y, -1});
    return shape(p, {{{2, 4, 0}},
                     {{0, 4, 5}},
                     {{0, 5, 1}},
                     {{1, 5, 6}},
                     {{1, 6, 3}},
                     {{2, 0, 7}},
                     {{0, 8, 7}},
                     {{0, 1, 8}},
                     {{1, 9, 8}},
                     {{1, 3, 9}}});
}

TEST(ShapeVerdict, pinch_when_faces_of_the_star_close) {
    const Promises bounds{.min_quality = 0};
    EXPECT_EQ(shape_of(ridge(), {0.5, 0, 0}, bounds).verdict, Verdict::kAccepted);
    EXPECT_EQ(shape_of(ridge(), {0.5, 0, 0.75}, bounds).verdict, Verdict::kPinch);
}

/// A face leans over the sheet, on its link edge 2-4, between regions 1 and 2.
Mesh sheet_under_a_page() {
    Mesh mesh = test::edge_in_sheet();
    const VertexId tip = mesh.add_vertex({0, 0.5, 1});
    mesh.add_face(VertexId{2}, VertexId{4}, tip, 1, 2);
    return mesh;
}

TEST(ShapeVerdict, pinch_when_a_face_closes_on_one_beyond_the_link) {
    const Promises bounds{.min_quality = 0};
    EXPECT_EQ(shape_of(sheet_under_a_page(), {0.5, 0, 1}, bounds).verdict, Verdict::kAccepted);
    EXPECT_EQ(shape_of(sheet_under_a_page(), {0.5, 0, 1.95}, bounds).verdict, Verdict::kPinch) << "within five degrees";
    EXPECT_EQ(shape_of(sheet_under_a_page(), {0.5, 0, 2.4}, bounds).verdict, Verdict::kPinch) << "through it";
    EXPECT_EQ(shape_of(test::edge_in_sheet(), {0.5, 0, 2.4}, bounds).verdict, Verdict::kAccepted) << "nothing is there";
}

}  // namespace
}  // namespace regionmesh
