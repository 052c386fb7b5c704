#include <gtest/gtest.h>

#include "regionmesh/check.h"
#include "support/random.h"
#include "support/runs.h"
#include "support/shapes.h"

namespace regionmesh {
namespace {

/// Every number of the report, to the last bit, and every sentence in its place.
void expect_same(const CheckReport& a, const CheckReport& b) {
    EXPECT_EQ(a.counts, b.counts);
    ASSERT_EQ(a.violations.size(), b.violations.size());
    for (std::size_t n = 0; n < a.violations.size(); ++n) {
        const Violation &x = a.violations[n], &y = b.violations[n];
        ASSERT_TRUE(x.kind == y.kind && x.vertices == y.vertices && x.faces == y.faces && x.text == y.text)
            << x.text << " / " << y.text;
    }
    ASSERT_EQ(a.regions.size(), b.regions.size());
    for (std::size_t n = 0; n < a.regions.size(); ++n) {
        const RegionReport &x = a.regions[n], &y = b.regions[n];
        EXPECT_TRUE(x.label == y.label && x.euler == y.euler && x.components == y.components);
        EXPECT_EQ(x.volume, y.volume);
        EXPECT_EQ(x.area, y.area);
    }
    EXPECT_EQ(a.quality.min, b.quality.min);
    EXPECT_EQ(a.quality.mean, b.quality.mean);
    EXPECT_EQ(a.quality.histogram, b.quality.histogram);
    EXPECT_EQ(a.quality.min_angle, b.quality.min_angle);
    EXPECT_EQ(a.quality.max_angle, b.quality.max_angle);
    EXPECT_EQ(a.quality.angle_histogram, b.quality.angle_histogram);
    EXPECT_EQ(a.quadruple_points_inside, b.quadruple_points_inside);
    EXPECT_EQ(a.region_pairs, b.region_pairs);
}

void expect_same_on_all_threads(const Mesh& mesh, CheckOptions options) {
    options.threads = 1;
    const CheckReport one = check(mesh, options);
    for (std::uint32_t threads : {2u, 3u, 8u}) {
        SCOPED_TRACE(testing::Message() << threads << " threads");
        options.threads = threads;
        expect_same(check(mesh, options), one);
    }
}

/// Large enough for several parts, with something wrong of nearly every kind in all of them.
Mesh broken_mesh() {
    Mesh mesh = test::run(test::noise_volume({16, 16, 16}, 5, 7)).mesh;
    test::Random random(8);
    const auto some_vertex = [&] { return VertexId{random.below(mesh.vertex_end())}; };
    const auto some_face = [&] {
        FaceId f{random.below(mesh.face_end())};
        while (!mesh.is_alive(f)) f = FaceId{random.below(mesh.face_end())};
        return f;
    };
    for (int n = 0; n < 300; ++n) {
        mesh[some_vertex()].position += 0.5 * random.point(1);
        const auto joined = mesh[some_face()].vertices;
        mesh[joined[0]].position = mesh.position(joined[1]);
        mesh.remove_face(some_face());
        const FaceId turned = some_face();
        const Face face = mesh[turned];
        mesh.remove_face(turned);
        mesh.add_face(face.vertices[0], face.vertices[2], face.vertices[1], face.labels[0], face.labels[1]);
        const Face twice = mesh[some_face()];
        mesh.add_face(twice.vertices[0], twice.vertices[2], twice.vertices[1], twice.labels[0], twice.labels[1]);
        const auto corners = mesh[some_face()].vertices;
        const VertexId loose = mesh.add_vertex(mesh.position(corners[2]) + random.point(1));
        mesh.add_face(corners[0], corners[1], loose, random.below(5), random.below(5));
        mesh.add_vertex(random.point(30));
        test::add_octahedron(mesh, {random.between(-30, -1), 0, 0}, {0.1, 0.1, 0.1}, 5, random.below(5));
    }
    return mesh;
}

TEST(CheckOnThreads, reports_the_same_of_a_sound_model) {
    expect_same_on_all_threads(test::run(test::noise_volume({16, 16, 16}, 5, 7)).mesh, {});
}

TEST(CheckOnThreads, reports_the_same_of_a_broken_model) {
    const Mesh mesh = broken_mesh();
    ASSERT_GT(mesh.face_end(), 50000u);
    ASSERT_GT(mesh.vertex_end(), 20000u);
    const CheckReport report = check(mesh);
    for (ViolationKind kind : {ViolationKind::kOpenEdge, ViolationKind::kOverfullEdge, ViolationKind::kOrientation,
                               ViolationKind::kPinchedVertex, ViolationKind::kDuplicateFace,
                               ViolationKind::kDegenerateFace, ViolationKind::kCoincidentVertices,
                               ViolationKind::kUnusedVertex, ViolationKind::kCrossingFaces, ViolationKind::kNesting})
        EXPECT_GT(report.counts[static_cast<int>(kind)], 10u) << to_string(kind);
    expect_same_on_all_threads(mesh, {});
    expect_same_on_all_threads(mesh, {.listed = 7});
    expect_same_on_all_threads(mesh, {.boundary_is_open = true, .background = {1}, .crossing = false});
}

TEST(CheckOnThreads, lists_the_first_findings_of_each_kind) {
    const Mesh mesh = broken_mesh();
    const CheckReport all = check(mesh, {.listed = 1u << 30}), some = check(mesh, {.listed = 7});
    std::array<std::uint32_t, kViolationKindCount> listed{};
    std::size_t n = 0;
    for (const Violation& violation : all.violations) {
        if (++listed[static_cast<int>(violation.kind)] > 7) continue;
        ASSERT_LT(n, some.violations.size());
        EXPECT_EQ(some.violations[n++].text, violation.text);
    }
    EXPECT_EQ(n, some.violations.size());
    EXPECT_EQ(all.violations.size(), all.violation_count());
}

TEST(CheckOnThreads, finds_the_same_in_another_order_of_faces) {
    Mesh mesh = broken_mesh();
    const CheckReport before = check(mesh);
    mesh.sort_spatially();
    EXPECT_EQ(check(mesh).counts, before.counts);
}

TEST(CheckOnThreads, a_run_reports_the_same) {
    ReconstructOptions options = test::reduced(0.5);
    options.threads = 1;
    const Reconstruction one = test::run(test::noise_volume({16, 16, 16}, 5, 7), options);
    options.threads = 3;
    expect_same(test::run(test::noise_volume({16, 16, 16}, 5, 7), options).report.check, one.report.check);
}

}  // namespace
}  // namespace regionmesh
