#include "regionmesh/check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>
#include <string>

#include "base/box.h"
#include "support/meshes.h"
#include "support/runs.h"
#include "support/shapes.h"

namespace regionmesh {
namespace {

using test::octahedron;
using test::shape;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

std::set<std::string> found_in(const Mesh& mesh, const CheckOptions& options = {}) {
    std::set<std::string> kinds;
    const CheckReport report = check(mesh, options);
    for (int kind = 0; kind < kViolationKindCount; ++kind)
        if (report.counts[kind]) kinds.insert(to_string(static_cast<ViolationKind>(kind)));
    return kinds;
}

std::uint64_t count(const CheckReport& report, ViolationKind kind) { return report.counts[static_cast<int>(kind)]; }

/// Label 1 is empty space, so that separate parts may lie in it.
const CheckOptions kIslands{.background = {1}};

TEST(Check, good_surfaces_have_no_violation) {
    EXPECT_THAT(found_in(octahedron()), ElementsAre());
    EXPECT_THAT(found_in(shape(test::kTetrahedronCorners, test::tetrahedron_faces())), ElementsAre());
    EXPECT_THAT(found_in(Mesh()), ElementsAre());
    for (const Reconstruction& made :
         {test::run(test::noise_volume({6, 6, 6}, 4, 1)), test::run(test::solid_volume({3, 4, 5}))})
        EXPECT_THAT(found_in(made.mesh), ElementsAre());
}

TEST(Check, a_vertex_that_is_nowhere_degenerates_its_faces) {
    for (const double nowhere : {std::nan(""), double{HUGE_VAL}, -double{HUGE_VAL}})
        for (std::uint32_t v = 0; v < 4; ++v) {
            Mesh mesh = shape(test::kTetrahedronCorners, test::tetrahedron_faces());
            mesh[VertexId{v}].position.z = nowhere;
            EXPECT_EQ(count(check(mesh), ViolationKind::kDegenerateFace), 3u) << nowhere << " of vertex " << v;
        }
}

TEST(Check, open_edge) {
    Mesh mesh = octahedron();
    mesh.remove_face(FaceId{0});
    EXPECT_THAT(found_in(mesh), ElementsAre("open_edge"));
    EXPECT_EQ(count(check(mesh), ViolationKind::kOpenEdge), 6u) << "three edges of two regions";
}

TEST(Check, an_edge_may_be_open_on_a_side_of_the_box_that_is_not_capped) {
    Mesh mesh = octahedron();
    mesh.remove_face(FaceId{0});
    for (VertexId v : mesh[FaceId{1}].vertices) mesh[v].sides = 1;
    EXPECT_THAT(found_in(mesh, {.boundary_is_open = true}), ElementsAre("open_edge")) << "elsewhere it may not";
    for (std::uint32_t v = 0; v < 6; ++v) mesh[VertexId{v}].sides = 1;
    EXPECT_THAT(found_in(mesh, {.boundary_is_open = true}), ElementsAre());
    EXPECT_THAT(found_in(mesh), ElementsAre("open_edge"));
}

TEST(Check, a_face_that_lies_in_a_side_of_the_box_may_not_end_there) {
    Mesh mesh =
        shape({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{{0, 1, 2}, 0, exterior(4)}, {{0, 2, 3}, 0, exterior(4)}});
    for (std::uint32_t v = 0; v < 4; ++v) mesh[VertexId{v}].sides = 1 << 4;
    const CheckReport report = check(mesh, {.boundary_is_open = true});
    EXPECT_EQ(count(report, ViolationKind::kOpenEdge), 4u);
    EXPECT_EQ(lock_violations(mesh, {.boundary_is_open = true}).vertices, 4u);
}

TEST(Check, overfull_edge) {
    // Two tetrahedra on the edge 0-1.
    const Mesh mesh =
        shape({{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {1, 1, 0}, {-1, 0, 0}, {-1, -1, 0}},
              {{{0, 1, 2}}, {{1, 0, 3}}, {{0, 2, 3}}, {{1, 3, 2}}, {{0, 1, 4}}, {{1, 0, 5}}, {{0, 4, 5}}, {{1, 5, 4}}});
    EXPECT_THAT(found_in(mesh), ElementsAre("overfull_edge"));
    EXPECT_EQ(count(check(mesh), ViolationKind::kOverfullEdge), 2u);
}

TEST(Check, orientation) {
    auto faces = test::tetrahedron_faces();
    std::swap(faces[2].v[0], faces[2].v[1]);
    EXPECT_THAT(found_in(shape(test::kTetrahedronCorners, faces)), ElementsAre("orientation"));
}

TEST(Check, pinched_vertex) {
    Mesh mesh = shape(test::kTetrahedronCorners, test::tetrahedron_faces(0, 1));
    // A second one in the opposite octant, at the same vertex 0.
    const VertexId o{0}, x = mesh.add_vertex({-1, 0, 0}), y = mesh.add_vertex({0, -1, 0}),
                         z = mesh.add_vertex({0, 0, -1});
    for (auto [a, b, c] : {std::array{o, x, y}, std::array{o, z, x}, std::array{o, y, z}, std::array{x, z, y}})
        mesh.add_face(a, b, c, 2, 1);
    EXPECT_THAT(found_in(mesh), ElementsAre("pinched_vertex"));
    EXPECT_EQ(count(check(mesh), ViolationKind::kPinchedVertex), 1u) << "only region 1 has two fans";
}

TEST(Check, few_edges) {
    // Two faces back to back.
    EXPECT_THAT(found_in(shape({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{{0, 1, 2}}, {{0, 2, 1}}})),
                ElementsAre("crossing_faces", "duplicate_face", "few_edges"));
}

TEST(Check, duplicate_face) {
    Mesh mesh = octahedron();
    const auto v = mesh[FaceId{0}].vertices;
    mesh.add_face(v[0], v[2], v[1], 0, 1);
    EXPECT_TRUE(found_in(mesh).contains("duplicate_face"));
    EXPECT_EQ(count(check(mesh), ViolationKind::kDuplicateFace), 1u);
}

TEST(Check, degenerate_face_without_area) {
    // Vertex 4 in the middle of edge 1-2 of a tetrahedron, and a face between.
    std::vector<Vec3> p = test::kTetrahedronCorners;
    p.push_back({0.5, 0.5, 0});
    const Mesh mesh = shape(p, {{{0, 2, 1}}, {{1, 2, 4}}, {{0, 1, 3}}, {{0, 3, 2}}, {{1, 4, 3}}, {{4, 2, 3}}});
    EXPECT_THAT(found_in(mesh), ElementsAre("crossing_faces", "degenerate_face"));
    EXPECT_EQ(count(check(mesh), ViolationKind::kDegenerateFace), 1u);
}

TEST(Check, degenerate_face_with_one_label) {
    auto faces = test::tetrahedron_faces();
    faces[1].second = 0;
    EXPECT_TRUE(found_in(shape(test::kTetrahedronCorners, faces)).contains("degenerate_face"));
}

TEST(Check, coincident_vertices) {
    Mesh mesh = octahedron();
    test::add_octahedron(mesh, {0, 0, 2});
    EXPECT_THAT(found_in(mesh, kIslands), ElementsAre("coincident_vertices", "crossing_faces"))
        << "touching is meeting";
    Mesh apart = octahedron();
    test::add_octahedron(apart, {0, 0, 2 + 1e-15});
    EXPECT_THAT(found_in(apart, kIslands), ElementsAre());
}

TEST(Check, unused_vertex) {
    Mesh mesh = octahedron();
    mesh.add_vertex({9, 9, 9});
    EXPECT_THAT(found_in(mesh), ElementsAre("unused_vertex"));
}

TEST(Check, regions_that_are_inside_out) {
    const auto box = [](double size) {
        Mesh mesh = test::run(test::grain_volume({8, 7, 6}, 5, 4)).mesh;
        for (std::uint32_t v = 0; v < mesh.vertex_end(); ++v)
            mesh[VertexId{v}].position = size * mesh.position(VertexId{v});
        return mesh;
    };
    EXPECT_THAT(found_in(box(1)), ElementsAre());
    EXPECT_THAT(found_in(box(-1)), ElementsAre("orientation"));
    EXPECT_EQ(count(check(box(-1)), ViolationKind::kOrientation), 5u) << "each grain";
    EXPECT_THAT(found_in(box(-1), {.boundary_is_open = true}), ElementsAre());
    Mesh outside;
    test::add_octahedron(outside, {}, {1, 1, -1});
    EXPECT_THAT(found_in(outside, kIslands), ElementsAre()) << "the region may be what is outside";
    Mesh halves = test::halved_octahedron();
    for (std::uint32_t v = 0; v < halves.vertex_end(); ++v)
        halves[VertexId{v}].position = -1 * halves.position(VertexId{v});
    EXPECT_THAT(found_in(halves, {.background = {2}}), ElementsAre("orientation"));
    EXPECT_EQ(count(check(halves), ViolationKind::kOrientation), 2u) << "only one of two can be outside";
}

TEST(Check, crossing_faces) {
    Mesh mesh = octahedron();
    test::add_octahedron(mesh, {0, 0, 1.2}, {0.1, 0.1, 0.5}, 2, 1);
    EXPECT_THAT(found_in(mesh, kIslands), ElementsAre("crossing_faces"));
    EXPECT_THAT(found_in(mesh, {.background = {1}, .crossing = false}), ElementsAre());
    for (const Violation& violation : check(mesh, kIslands).violations)
        for (const std::uint32_t f : violation.faces)
            EXPECT_TRUE(is_within(violation.at.value(), box_of(mesh.corners(FaceId{f})))) << violation.text;
}

TEST(Check, crossing_faces_that_share_a_vertex) {
    Mesh mesh = octahedron();
    mesh[VertexId{1}].position = {-0.9, 0, 0.8};  // +x leans through the pyramid below -x
    EXPECT_THAT(found_in(mesh), ElementsAre("crossing_faces"));
}

TEST(Check, euler_quadruple_points_and_region_pairs) {
    const LabelOracle right{.euler = {2, 2}, .quadruple_points_inside = 0, .region_pairs = 1};
    CheckOptions options{.oracle = right};
    EXPECT_THAT(found_in(octahedron(), options), ElementsAre());
    options.oracle->euler[0] = 4;
    EXPECT_THAT(found_in(octahedron(), options), ElementsAre("euler"));
    options.oracle = right;
    options.oracle->quadruple_points_inside = 1;
    EXPECT_THAT(found_in(octahedron(), options), ElementsAre("quadruple_points"));
    options.oracle = right;
    options.oracle->region_pairs = 2;
    EXPECT_THAT(found_in(octahedron(), options), ElementsAre("region_pairs"));
}

TEST(Check, a_region_of_the_labels_without_a_face_is_found_missing) {
    CheckOptions options{.oracle = LabelOracle{.euler = {2, 2, 2}, .quadruple_points_inside = 0, .region_pairs = 1}};
    EXPECT_THAT(found_in(octahedron(), options), ElementsAre("euler"));
}

/// A large octahedron of region 0 in region 1, and a small one of region 2 that says it lies in `round`.
Mesh island(Vec3 middle, Label round) {
    Mesh mesh;
    test::add_octahedron(mesh, {}, {3, 3, 3}, 0, 1);
    test::add_octahedron(mesh, middle, {0.5, 0.5, 0.5}, 2, round);
    return mesh;
}

TEST(Check, nesting) {
    EXPECT_THAT(found_in(island({0.1, 0.2, 0.3}, 0), kIslands), ElementsAre()) << "inside, and says so";
    EXPECT_THAT(found_in(island({5, 0.2, 0.3}, 1), kIslands), ElementsAre()) << "outside, and says so";
    EXPECT_THAT(found_in(island({-5, 0.2, 0.3}, 1), kIslands), ElementsAre()) << "outside, with the other beyond";
    EXPECT_THAT(found_in(island({0.1, 0.2, 0.3}, 1), kIslands), ElementsAre("nesting"));
    EXPECT_THAT(found_in(island({5, 0.2, 0.3}, 0), kIslands), ElementsAre("nesting"));
    EXPECT_THAT(found_in(island({-5, 0.2, 0.3}, 0), kIslands), ElementsAre("nesting"));
}

TEST(Check, nesting_of_bodies_in_the_exterior) {
    const auto bodies = [](Vec3 middle, double size, Label inner, Label outer) {
        Mesh mesh;
        test::add_octahedron(mesh, {}, {3, 3, 3}, 0, exterior(0));
        test::add_octahedron(mesh, middle, {size, size, size}, inner, outer);
        return mesh;
    };
    EXPECT_THAT(found_in(bodies({5, 0.2, 0.3}, 0.5, 1, exterior(0))), ElementsAre()) << "beside it";
    EXPECT_THAT(found_in(bodies({-5, 0.2, 0.3}, 0.5, 1, exterior(0))), ElementsAre()) << "with the other beyond";
    EXPECT_THAT(found_in(bodies({0.1, 0.2, 0.3}, 0.5, 1, exterior(0))), ElementsAre("nesting")) << "inside it";
    EXPECT_THAT(found_in(bodies({0.1, 0.2, 0.3}, 0.5, exterior(0), 0)), ElementsAre()) << "a hollow in it";
    EXPECT_THAT(found_in(bodies({5, 0.2, 0.3}, 0.5, exterior(0), 0)), Contains("nesting")) << "a hollow beside it";
}

TEST(Check, bodies_that_touch_do_not_lie_in_each_other) {
    for (const Label outer : {exterior(0), exterior(kHull)}) {
        Mesh mesh;
        test::add_octahedron(mesh, {}, {3, 3, 3}, 0, outer);
        test::add_octahedron(mesh, {6, 0, 0}, {3, 3, 3}, 1, outer);
        if (outer == exterior(kHull)) test::for_vertices(mesh, [&](VertexId v) { mesh[v].sides = kOnHull; });
        EXPECT_THAT(found_in(mesh), Contains("coincident_vertices"));
        EXPECT_THAT(found_in(mesh), testing::Not(Contains("nesting")));
    }
}

TEST(Check, nesting_of_bodies_with_a_hull) {
    // A hull that is no box touches every body.
    for (const bool is_nested : {false, true}) {
        Mesh mesh;
        test::add_octahedron(mesh, {}, {3, 3, 3}, 0, exterior(kHull));
        test::add_octahedron(mesh, is_nested ? Vec3{0.1, 0.2, 0.3} : Vec3{5, 0.2, 0.3}, {0.5, 0.5, 0.5}, 1,
                             exterior(kHull));
        test::for_vertices(mesh, [&](VertexId v) { mesh[v].sides = kOnHull; });
        EXPECT_EQ(found_in(mesh), is_nested ? std::set<std::string>{"nesting"} : std::set<std::string>{});
    }
}

TEST(Check, the_background_may_end_twice_at_an_edge_of_a_hull) {
    // Tetrahedra round the edge 0-1: two of the background, each beside another label and a gap.
    LabelledPoints points{.positions = {{0, 0, 0}, {0, 0, 1}}, .labels = {}};
    for (const double degrees : {0, 50, 100, 180, 230, 280}) {
        const double angle = degrees * std::numbers::pi / 180;
        points.positions.push_back({std::cos(angle), std::sin(angle), 0});
    }
    using Labels = std::array<InputLabel, 4>;
    for (const Labels& labels : {Labels{0, 1, 0, 2}, Labels{0, 1, 2, 0}}) {
        test::ArrayMesh mesh(points, {{{0, 1, 2, 3}, labels[0]},
                                      {{0, 1, 3, 4}, labels[1]},
                                      {{0, 1, 5, 6}, labels[2]},
                                      {{0, 1, 6, 7}, labels[3]}});
        ReconstructOptions options;
        options.smooth.passes = 0;
        options.background = {0};
        const Reconstruction made = reconstruct(mesh, options);
        EXPECT_EQ(made.report.check.violation_count(), 0u) << labels[1] << labels[2] << labels[3];
        EXPECT_EQ(made.report.check.regions.size(), 2u);
    }
}

TEST(Check, a_face_turned_over_at_an_open_side_is_found) {
    // The side of a tetrahedron, which lies in the side of the box.
    auto faces = test::tetrahedron_faces();
    std::swap(faces[0].v[0], faces[0].v[1]);
    Mesh mesh = shape(test::kTetrahedronCorners, faces);
    for (const VertexId v : mesh[FaceId{0}].vertices) mesh[v].sides = 1;
    EXPECT_EQ(count(check(mesh, {.boundary_is_open = true}), ViolationKind::kOrientation), 6u);  // edges and labels
}

TEST(Check, nesting_finds_an_island_moved_into_the_wrong_region) {
    // Label 3 in the middle of 1; beside it a slab of 2.
    const test::TextVolume::Section plain{"1111122", "1111122", "1111122", "1111122", "1111122"};
    test::TextVolume::Section with_island = plain;
    with_island[2] = "1131122";
    Reconstruction made = test::run(test::TextVolume({plain, plain, with_island, plain, plain}));
    EXPECT_THAT(found_in(made.mesh), ElementsAre());
    const Vec3 middle{2, 2, 2};
    test::for_vertices(made.mesh, [&](VertexId v) {
        Vec3& p = made.mesh[v].position;
        if (length(p - middle) < 1) p = Vec3{5.25, 2, 2} + 0.5 * (p - middle);
    });
    EXPECT_THAT(found_in(made.mesh), ElementsAre("nesting"));
}

TEST(Check, a_finding_names_what_it_is_about) {
    Mesh mesh = octahedron();
    mesh.remove_face(FaceId{0});
    const CheckReport report = check(mesh, {.label_text = [](Label label) { return label ? "liver" : "bone"; }});
    ASSERT_FALSE(report.violations.empty());
    const Violation& first = report.violations[0];
    EXPECT_EQ(first.vertices.size(), 2u);
    EXPECT_THAT(first.text, HasSubstr(std::to_string(first.vertices[0])));
    EXPECT_TRUE(first.text.find("liver") != std::string::npos || first.text.find("bone") != std::string::npos)
        << first.text;
}

TEST(Check, lists_some_and_counts_all) {
    Mesh mesh = octahedron();
    for (int n = 0; n < 10; ++n) mesh.add_vertex({n + 5.0, 0, 0});
    const CheckReport report = check(mesh, {.listed = 3});
    EXPECT_EQ(report.violations.size(), 3u);
    EXPECT_EQ(report.violation_count(), 10u);
}

TEST(Check, measures_volume_area_and_euler_of_an_octahedron) {
    const CheckReport report = check(octahedron());
    ASSERT_EQ(report.regions.size(), 2u);
    EXPECT_NEAR(report.regions[0].volume, 4.0 / 3, 1e-12);
    EXPECT_NEAR(report.regions[1].volume, -4.0 / 3, 1e-12) << "the outside counts negative";
    EXPECT_NEAR(report.regions[0].area, 4 * std::sqrt(3.0), 1e-12);
    EXPECT_EQ(report.regions[0].euler, 2);
    EXPECT_EQ(report.regions[0].components, 1u);
    EXPECT_EQ(report.region_pairs, 1u);
}

TEST(Check, measures_a_box_with_its_spacing) {
    const Reconstruction made = test::run(test::solid_volume({5, 4, 3}).spaced({1, 2, 5}));
    ASSERT_EQ(made.report.check.regions.size(), 1u);
    EXPECT_NEAR(made.report.check.regions[0].volume, 4 * 6 * 10, 1e-9);
    EXPECT_NEAR(made.report.check.regions[0].area, 2 * (4 * 6 + 6 * 10 + 4 * 10), 1e-9);
    EXPECT_NEAR(made.report.check.quality.max_angle, 90, 1e-9);
}

TEST(Check, counts_the_components_of_a_hollow_region) {
    const test::TextVolume::Section full{"11111", "11111", "11111", "11111", "11111"},
        hollow{"11111", "11111", "11211", "11111", "11111"};
    const Reconstruction made = test::run(test::TextVolume({full, full, hollow, full, full}));
    ASSERT_EQ(made.report.check.regions.size(), 2u);
    EXPECT_EQ(made.report.check.regions[0].components, 2u);
    EXPECT_EQ(made.report.check.regions[0].euler, 4);
    EXPECT_EQ(made.report.check.regions[1].components, 1u);
}

TEST(Check, histograms_hold_every_face_and_angle) {
    const Reconstruction made = test::run(test::noise_volume({6, 6, 6}, 3, 1));
    const QualityReport& quality = made.report.check.quality;
    std::uint64_t faces = 0, angles = 0;
    for (std::uint64_t n : quality.histogram) faces += n;
    for (std::uint64_t n : quality.angle_histogram) angles += n;
    EXPECT_EQ(faces, made.mesh.face_count());
    EXPECT_EQ(angles, 3 * faces);
    EXPECT_GT(quality.mean, quality.min);
    EXPECT_GT(quality.min_angle, 0);
    EXPECT_LT(quality.max_angle, 180);
}

TEST(Check, each_kind_has_a_name_of_its_own) {
    std::set<std::string> names;
    for (int kind = 0; kind < kViolationKindCount; ++kind) names.insert(to_string(static_cast<ViolationKind>(kind)));
    EXPECT_EQ(names.size(), std::size_t(kViolationKindCount));
}

}  // namespace
}  // namespace regionmesh
