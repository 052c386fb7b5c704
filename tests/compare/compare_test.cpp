#include "regionmesh/compare.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "regionmesh/error.h"
#include "regionmesh/write_report.h"
#include "support/labels.h"
#include "support/runs.h"
#include "support/shapes.h"

namespace regionmesh {
namespace {

using testing::ElementsAre;

/// All labels are regions; few samples.
const CompareOptions kFew{.samples = 20000, .background = {}, .threads = 1};

Mesh square(double z) { return test::shape({{0, 0, z}, {1, 0, z}, {1, 1, z}, {0, 1, z}}, {{{0, 1, 2}}, {{0, 2, 3}}}); }

/// The box 1 x 1 x 2: label 0 up to `middle`, 1 above, capped.
Mesh stack(double middle, Label lower = 0, Label upper = 1) {
    Mesh mesh;
    for (int i = 0; i < 12; ++i) {
        const int x = i & 1, y = i >> 1 & 1, z = i >> 2;
        const int sides = 1 << x | 1 << (2 + y) | (z == 0 ? 1 << 4 : z == 2 ? 1 << 5 : 0);
        mesh.add_vertex({1.0 * x, 1.0 * y, z == 1 ? middle : 1.0 * z}, static_cast<SideSet>(sides));
    }
    const auto quad = [&](std::array<std::uint32_t, 4> v, Label first, Label second) {
        mesh.add_face(VertexId{v[0]}, VertexId{v[1]}, VertexId{v[2]}, first, second);
        mesh.add_face(VertexId{v[0]}, VertexId{v[2]}, VertexId{v[3]}, first, second);
    };
    quad({0, 2, 3, 1}, lower, exterior(4));
    if (lower != upper) quad({4, 5, 7, 6}, lower, upper);
    quad({8, 9, 11, 10}, upper, exterior(5));
    for (std::uint32_t low : {0, 4}) {
        const Label label = low == 0 ? lower : upper;
        quad({low, low + 1, low + 5, low + 4}, label, exterior(2));
        quad({low + 1, low + 3, low + 7, low + 5}, label, exterior(1));
        quad({low + 3, low + 2, low + 6, low + 7}, label, exterior(3));
        quad({low + 2, low, low + 4, low + 6}, label, exterior(0));
    }
    return mesh;
}

/// A ball of radius 1 round `middle`: an octahedron, each face of which is cut into four `cuts` times.
Mesh ball(Vec3 middle, int cuts) {
    std::vector<std::array<Vec3, 3>> faces;
    const Mesh octahedron = test::octahedron();
    for (std::uint32_t f = 0; f < octahedron.face_end(); ++f) faces.push_back(octahedron.corners(FaceId{f}));
    for (int n = 0; n < cuts; ++n) {
        std::vector<std::array<Vec3, 3>> finer;
        for (const auto& [a, b, c] : faces) {
            const auto half = [](Vec3 p, Vec3 q) { return (p + q) / length(p + q); };
            const Vec3 ab = half(a, b), bc = half(b, c), ca = half(c, a);
            finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
        }
        faces = std::move(finer);
    }
    Mesh mesh;
    for (const auto& corners : faces) {
        std::array<VertexId, 3> v;
        for (int n = 0; n < 3; ++n) v[n] = mesh.add_vertex(middle + corners[n]);
        mesh.add_face(v[0], v[1], v[2], 0, 1);
    }
    return mesh;
}

CompareReport compared(const Mesh& a, const Mesh& b, const CompareOptions& options = kFew) {
    const LabelTable labels = test::labels_from({1, 2});
    return compare({a, labels}, {b, labels}, options);
}

void expect_all(const TwoSidedDistance& found, double distance, double tolerance = 1e-12) {
    for (const auto& statistics : {found.a_to_b, found.b_to_a, found.both}) {
        ASSERT_TRUE(statistics);
        EXPECT_NEAR(statistics->rms, distance, tolerance);
        EXPECT_NEAR(statistics->mean, distance, tolerance);
        EXPECT_NEAR(statistics->max, distance, tolerance);
        EXPECT_NEAR(statistics->quantile_95, distance, tolerance);
    }
}

TEST(Compare, parallel_squares_are_one_distance_apart) {
    for (const double d : {1.0, 0.25, 1e-3}) expect_all(compared(square(0), square(d)).distance, d);
}

TEST(Compare, a_table_has_all_labels_of_the_mesh) {
    const Mesh mesh = stack(1);  // labels 0 and 1
    LabelTable labels;
    labels.dense(5);
    EXPECT_THROW(ComparedMesh(mesh, labels), Error);
    labels.dense(6);
    EXPECT_NO_THROW(ComparedMesh(mesh, labels));
}

TEST(Compare, a_model_is_at_no_distance_from_itself) {
    const Reconstruction made = test::run(test::grain_volume({9, 8, 7}, 6, 11));
    const ComparedMesh mesh{made.mesh, made.labels};
    const CompareReport report = compare(mesh, mesh, kFew);
    expect_all(report.distance, 0, 0);
    EXPECT_EQ(report.regions.size(), 6u);
    EXPECT_GT(report.interfaces.size(), 6u);
    EXPECT_GT(report.lines.size(), 6u);
    for (const auto& region : report.regions) expect_all(region.distance, 0, 0);
    for (const auto& interface : report.interfaces) expect_all(interface.distance, 0, 0);
    for (const auto& line : report.lines) expect_all(line.distance, 0, 0);
    EXPECT_EQ(report.quality[0].histogram, report.quality[1].histogram);
}

/// The same surface, with vertices and faces in reverse order, and each face seen from its other label.
Mesh reversed(const Mesh& mesh) {
    Mesh made;
    const std::uint32_t end = mesh.vertex_end();
    for (std::uint32_t v = end; v-- > 0;) made.add_vertex(mesh.position(VertexId{v}), mesh[VertexId{v}].sides);
    for (std::uint32_t f = mesh.face_end(); f-- > 0;) {
        if (!mesh.is_alive(FaceId{f})) continue;
        const auto& v = mesh[FaceId{f}].vertices;
        const auto& labels = mesh[FaceId{f}].labels;
        const auto id = [&](VertexId old) { return VertexId{end - 1 - index(old)}; };
        made.add_face(id(v[2]), id(v[1]), id(v[0]), labels[1], labels[0]);
    }
    return made;
}

std::array<double, 8> numbers_of(const TwoSidedDistance& distance) {
    const DistanceStatistics &a = *distance.a_to_b, &b = *distance.b_to_a;
    return {a.rms, a.mean, a.max, a.quantile_95, b.rms, b.mean, b.max, b.quantile_95};
}

TEST(Compare, distances_do_not_depend_on_the_order_of_vertices_faces_and_corners) {
    test::ArrayVolume volume = test::grain_volume({12, 11, 10}, 6, 11);
    Reconstruction full = test::run(volume), model = test::run(volume, test::reduced(0.5));
    const auto compared = [&](const Mesh& a, const Mesh& b) {
        return compare({a, full.labels}, {b, model.labels}, kFew);
    };
    full.mesh.compact();
    model.mesh.compact();
    const CompareReport given = compared(full.mesh, model.mesh),
                        turned = compared(reversed(full.mesh), reversed(model.mesh));
    EXPECT_GT(given.distance.both->rms, 0);
    EXPECT_EQ(numbers_of(given.distance), numbers_of(turned.distance));
    ASSERT_EQ(given.interfaces.size(), turned.interfaces.size());
    for (std::size_t n = 0; n < given.interfaces.size(); ++n)
        EXPECT_EQ(numbers_of(given.interfaces[n].distance), numbers_of(turned.interfaces[n].distance));
    ASSERT_EQ(given.lines.size(), turned.lines.size());
    for (std::size_t n = 0; n < given.lines.size(); ++n)
        EXPECT_EQ(numbers_of(given.lines[n].distance), numbers_of(turned.lines[n].distance));
}

TEST(Compare, shifted_balls) {
    constexpr double kShift = 0.01;
    const CompareReport report = compared(ball({}, 5), ball({kShift, 0, 0}, 5));
    const DistanceStatistics& both = *report.distance.both;
    EXPECT_NEAR(both.mean, kShift / 2, 0.02 * kShift) << "the mean of |cos| over a ball";
    EXPECT_NEAR(both.rms, kShift / std::sqrt(3), 0.02 * kShift);
    EXPECT_NEAR(both.quantile_95, 0.95 * kShift, 0.02 * kShift);
    EXPECT_NEAR(both.max, kShift, 0.01 * kShift);
    EXPECT_NEAR(report.regions[0].measures[0]->volume, 4.18, 0.02);
    EXPECT_NEAR(report.distance.a_to_b->rms, report.distance.b_to_a->rms, 1e-3 * kShift);
}

TEST(Compare, shifted_boxes) {
    constexpr double kShift = 0.125;
    Mesh moved = stack(1);
    for (std::uint32_t v = 0; v < moved.vertex_end(); ++v) moved[VertexId{v}].position.x += kShift;
    const CompareReport report = compared(stack(1), moved);
    EXPECT_NEAR(report.distance.both->max, kShift, 1e-12) << "on the sides that the shift is square to";
    EXPECT_GT(report.distance.both->rms, 0.3 * kShift);
    EXPECT_LT(report.distance.both->rms, kShift);
    EXPECT_NEAR(report.distance.a_to_b->mean, report.distance.b_to_a->mean, 0.01 * kShift) << "mirror images";
    for (const RegionComparison& region : report.regions) {
        EXPECT_NEAR(region.measures[0]->volume, 1, 1e-12);
        EXPECT_NEAR(region.measures[1]->volume, 1, 1e-12);
    }
}

TEST(Compare, moved_interface_is_told_from_the_rest) {
    const CompareReport report = compared(stack(1), stack(1.25));
    ASSERT_EQ(report.regions.size(), 2u);
    EXPECT_NEAR(report.regions[0].measures[1]->volume, 1.25, 1e-12);
    EXPECT_NEAR(report.regions[1].measures[1]->volume, 0.75, 1e-12);
    EXPECT_EQ(report.regions[0].measures[1]->euler, 2);
    EXPECT_NEAR(report.regions[0].measures[1]->area, 7, 1e-12);
    ASSERT_EQ(report.interfaces.size(), 3u);
    EXPECT_THAT(report.interfaces[0].labels, ElementsAre(0, 1));
    expect_all(report.interfaces[0].distance, 0.25);
    EXPECT_THAT(report.interfaces[1].labels, ElementsAre(0, exterior(0)));
    EXPECT_NEAR(*report.interfaces[1].measures[1], 6, 1e-12);
    EXPECT_EQ(report.interfaces[1].distance.a_to_b->max, 0) << "a part of the other";
    EXPECT_NEAR(report.interfaces[1].distance.b_to_a->max, 0.25, 0.01);
}

TEST(Compare, lines_are_named_by_all_their_labels) {
    const CompareReport report = compared(stack(1), stack(1.25));
    ASSERT_EQ(report.lines.size(), 3u) << "the rim of the interface, and edges of the box of either region";
    EXPECT_THAT(report.lines[0].labels, ElementsAre(0, 1, exterior(0)));
    EXPECT_NEAR(*report.lines[0].measures[0], 4, 1e-12);
    expect_all(report.lines[0].distance, 0.25);
    EXPECT_THAT(report.lines[1].labels, ElementsAre(0, exterior(0), exterior(0)));
    EXPECT_NEAR(*report.lines[1].measures[0], 8, 1e-12);
    EXPECT_NEAR(*report.lines[1].measures[1], 9, 1e-12);
}

TEST(Compare, edges_of_the_box_are_no_lines_where_one_model_does_not_know_its_sides) {
    for (const int sides : {0, static_cast<int>(kOnHull)}) {
        Mesh other = stack(1.25);
        for (std::uint32_t v = 0; v < other.vertex_end(); ++v) other[VertexId{v}].sides = static_cast<SideSet>(sides);
        for (const CompareReport& report : {compared(stack(1), other), compared(other, stack(1))}) {
            ASSERT_EQ(report.lines.size(), 1u);
            EXPECT_THAT(report.lines[0].labels, ElementsAre(0, 1, exterior(0)));
            expect_all(report.lines[0].distance, 0.25);
        }
    }
}

TEST(Compare, what_only_one_model_has_is_there_without_distance) {
    const CompareReport report = compared(stack(1), stack(1, 0, 0));
    expect_all(compared(stack(1, 0, 0), stack(1, 0, 0)).distance, 0, 0);
    ASSERT_EQ(report.regions.size(), 2u);
    EXPECT_TRUE(report.regions[0].measures[1] && report.regions[0].distance.both);
    EXPECT_TRUE(report.regions[1].measures[0]);
    EXPECT_FALSE(report.regions[1].measures[1]);
    EXPECT_FALSE(report.regions[1].distance.a_to_b || report.regions[1].distance.b_to_a ||
                 report.regions[1].distance.both);
    ASSERT_EQ(report.interfaces.size(), 3u);
    EXPECT_THAT(report.interfaces[0].labels, ElementsAre(0, 1));
    EXPECT_FALSE(report.interfaces[0].measures[1] || report.interfaces[0].distance.both);
    EXPECT_TRUE(report.interfaces[1].distance.both);
    EXPECT_GT(report.distance.a_to_b->max, 0.4) << "the middle of the interface counts for the whole";
    EXPECT_EQ(report.distance.b_to_a->max, 0);
}

TEST(Compare, labels_match_as_the_input_has_them) {
    const Mesh straight = stack(1, 0, 1), crossed = stack(1.25, 1, 0);
    const CompareReport report =
        compare({straight, test::labels_from({40, -3})}, {crossed, test::labels_from({-3, 40, 7})}, kFew);
    EXPECT_EQ(report.labels.size(), 3u);
    EXPECT_EQ(report.labels.input(0), -3) << "as numbers ascending";
    ASSERT_EQ(report.regions.size(), 2u);
    EXPECT_NEAR(report.regions[0].measures[0]->volume, 1, 1e-12);
    EXPECT_NEAR(report.regions[0].measures[1]->volume, 0.75, 1e-12);
    ASSERT_EQ(report.interfaces.size(), 3u);
    expect_all(report.interfaces[0].distance, 0.25);
}

TEST(Compare, labels_of_2_to_the_63_and_more_are_not_negative_ones) {
    const Mesh mesh = stack(1);
    const LabelTable large = test::labels_from({std::numeric_limits<InputLabel>::min(), 5}, true),
                     small = test::labels_from({5, 7}), byte = test::labels_from({5, 7}, true),
                     negative = test::labels_from({std::numeric_limits<InputLabel>::min(), 5});
    for (const LabelTable* other : {&small, &byte}) {
        const CompareReport report = compare({mesh, large}, {mesh, *other}, kFew);
        EXPECT_EQ(report.labels.size(), 3u);
        EXPECT_EQ(report.labels.text(report.labels.input(2)), "9223372036854775808");
    }
    EXPECT_EQ(compare({mesh, negative}, {mesh, byte}, kFew).labels.size(), 3u);
    EXPECT_THROW(compare({mesh, large}, {mesh, negative}, kFew), Error);
}

TEST(Compare, background_is_no_region_and_its_faces_with_the_exterior_count_nowhere) {
    Mesh without = stack(1);
    for (std::uint32_t f = 0; f < without.face_end(); ++f)
        if (without[FaceId{f}].labels[0] == 1) without.remove_face(FaceId{f});
    CompareOptions options = kFew;
    options.background = {2};
    const CompareReport report = compared(stack(1), without, options);
    expect_all(report.distance, 0, 0);
    ASSERT_EQ(report.regions.size(), 1u);
    EXPECT_EQ(report.interfaces.size(), 2u);
    for (const auto& interface : report.interfaces) EXPECT_TRUE(interface.distance.both);
    for (const auto& line : report.lines) EXPECT_TRUE(line.distance.both) << testing::PrintToString(line.labels);
}

TEST(Compare, vertices_have_their_distances) {
    CompareOptions options = kFew;
    EXPECT_THAT(compared(square(0), square(1), options).vertex_distances, ElementsAre());
    options.vertex_distances = true;
    Mesh a = test::shape({{0, 0, 3}, {1, 0, 0}, {1, 1, 0}, {0, 5, 0}, {9, 9, 9}}, {{{0, 1, 2}}, {{0, 2, 3}}});
    a.remove_vertex(VertexId{4});
    EXPECT_THAT(compared(a, square(0), options).vertex_distances, ElementsAre(3, 0, 0, 4, 0));
}

TEST(Compare, models_without_faces_have_no_distance) {
    const Mesh none;
    for (const CompareReport& report : {compared(none, square(0)), compared(square(0), none), compared(none, none)}) {
        EXPECT_FALSE(report.distance.both || report.distance.a_to_b || report.distance.b_to_a);
        EXPECT_NE(compare_json(report), "");
    }
}

TEST(Compare, result_does_not_depend_on_threads) {
    test::ArrayVolume volume = test::grain_volume({14, 13, 12}, 12, 5);
    const Reconstruction full = test::run(volume), reduced = test::run(volume, test::reduced(0.8));
    std::vector<std::string> texts;
    std::vector<std::vector<double>> distances;
    for (const std::uint32_t threads : {1, 2, 3}) {
        const CompareOptions options{.samples = 30000, .background = {}, .vertex_distances = true, .threads = threads};
        const auto report = compare({full.mesh, full.labels}, {reduced.mesh, reduced.labels}, options);
        texts.push_back(compare_json(report));
        distances.push_back(report.vertex_distances);
    }
    EXPECT_EQ(texts[0], texts[1]);
    EXPECT_EQ(texts[0], texts[2]);
    EXPECT_EQ(distances[0], distances[1]);
    EXPECT_EQ(distances[0], distances[2]);
}

TEST(Compare, narrower_sets_are_never_nearer) {
    test::ArrayVolume volume = test::grain_volume({12, 12, 12}, 9, 3);
    const Reconstruction full = test::run(volume), reduced = test::run(volume, test::reduced(0.8));
    const auto report = compare({full.mesh, full.labels}, {reduced.mesh, reduced.labels}, kFew);
    EXPECT_GT(report.distance.both->rms, 0.01);
    EXPECT_LT(report.distance.both->rms, 0.3);
    double largest = 0;
    for (const auto& region : report.regions) largest = std::max(largest, region.distance.both->max);
    EXPECT_GE(largest, report.distance.both->max);
    double among_interfaces = 0;
    for (const auto& interface : report.interfaces)
        among_interfaces = std::max(among_interfaces, interface.distance.both->max);
    EXPECT_GE(among_interfaces, largest);
    for (const auto& region : report.regions) EXPECT_EQ(region.measures[0]->euler, region.measures[1]->euler);
}

}  // namespace
}  // namespace regionmesh
