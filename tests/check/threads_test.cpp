#include <gtest/gtest.h>

#include "regionmesh/check/check.h"
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
        ASSERT_TRUE(x.kind == y.kind && x.vertices == y.vertices && x.faces == y.faces && x.text == y.text) << x.text << " / " << y.text;
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

void expect_same_on_all_threads(const Model& model, CheckOptions options) {
    options.threads = 1;
    const CheckReport one = check(model, options);
    for (std::uint32_t threads : {2u, 3u, 8u}) {
        SCOPED_TRACE(testing::Message() << threads << " threads");
        options.threads = threads;
        expect_same(check(model, options), one);
    }
}

/// Large enough for several parts, with something wrong of nearly every kind in all of them.
Model broken_model() {
    Model model = test::run(test::noise_volume({16, 16, 16}, 5, 7)).model;
    test::Random random(8);
    const auto some_vertex = [&] { return VertexId{random.below(model.vertex_end())}; };
    const auto some_face = [&] {
        FaceId f{random.below(model.face_end())};
        while (!model.is_alive(f)) f = FaceId{random.below(model.face_end())};
        return f;
    };
    for (int n = 0; n < 300; ++n) {
        model[some_vertex()].position += 0.5 * random.point(1);
        const auto joined = model[some_face()].vertices;
        model[joined[0]].position = model.position(joined[1]);
        model.remove_face(some_face());
        const FaceId turned = some_face();
        const Face face = model[turned];
        model.remove_face(turned);
        model.add_face(face.vertices[0], face.vertices[2], face.vertices[1], face.labels[0], face.labels[1]);
        const Face twice = model[some_face()];
        model.add_face(twice.vertices[0], twice.vertices[2], twice.vertices[1], twice.labels[0], twice.labels[1]);
        const auto corners = model[some_face()].vertices;
        const VertexId loose = model.add_vertex(model.position(corners[2]) + random.point(1));
        model.add_face(corners[0], corners[1], loose, random.below(5), random.below(5));
        model.add_vertex(random.point(30));
        test::add_octahedron(model, {random.between(-30, -1), 0, 0}, {0.1, 0.1, 0.1}, 5, random.below(5));
    }
    return model;
}

TEST(CheckOnThreads, reports_the_same_of_a_sound_model) {
    expect_same_on_all_threads(test::run(test::noise_volume({16, 16, 16}, 5, 7)).model, {});
}

TEST(CheckOnThreads, reports_the_same_of_a_broken_model) {
    const Model model = broken_model();
    ASSERT_GT(model.face_end(), 50000u);
    ASSERT_GT(model.vertex_end(), 20000u);
    const CheckReport report = check(model);
    for (ViolationKind kind : {ViolationKind::kOpenEdge, ViolationKind::kOverfullEdge, ViolationKind::kOrientation,
                               ViolationKind::kPinchedVertex, ViolationKind::kDuplicateFace, ViolationKind::kDegenerateFace,
                               ViolationKind::kCoincidentVertices, ViolationKind::kUnusedVertex, ViolationKind::kCrossingFaces,
                               ViolationKind::kNesting})
        EXPECT_GT(report.counts[static_cast<int>(kind)], 10u) << to_string(kind);
    expect_same_on_all_threads(model, {});
    expect_same_on_all_threads(model, {.listed = 7});
    expect_same_on_all_threads(model, {.boundary_is_open = true, .background = {1}, .crossing = false});
}

TEST(CheckOnThreads, lists_the_first_findings_of_each_kind) {
    const Model model = broken_model();
    const CheckReport all = check(model, {.listed = 1u << 30}), some = check(model, {.listed = 7});
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
    Model model = broken_model();
    const CheckReport before = check(model);
    model.sort_spatially();
    EXPECT_EQ(check(model).counts, before.counts);
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
