// A model in parts is compared as the same model in one.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "mesh/mesh_part.h"
#include "regionmesh/compare.h"
#include "regionmesh/write_report.h"
#include "support/labels.h"
#include "support/runs.h"

namespace regionmesh {
namespace {

/// A mesh whose faces and vertices belong to parts by their place.
class DividedMesh : public ComparedModel {
public:
    using PartOf = std::function<std::uint32_t(Vec3)>;

    DividedMesh(const Mesh& mesh, const LabelTable& labels, std::uint32_t parts, const PartOf& part_of)
        : whole_(mesh, labels), mesh_(mesh), reads_(parts) {
        for (std::uint32_t v = 0; v < mesh.vertex_end(); ++v)
            part_.of_vertex.push_back(mesh.is_alive(VertexId{v}) ? part_of(mesh.position(VertexId{v})) : 0);
        for (std::uint32_t f = 0; f < mesh.face_end(); ++f) {
            if (!mesh.is_alive(FaceId{f})) {
                part_.of_face.push_back(0);
                continue;
            }
            const auto [a, b, c] = mesh.corners(FaceId{f});
            part_.of_face.push_back(part_of((a + b + c) / 3));
        }
    }

    const LabelTable& labels() const override { return whole_.labels(); }
    std::uint64_t face_count() const override { return whole_.face_count(); }
    std::uint64_t vertex_count() const override { return whole_.vertex_count(); }
    bool has_sides() const override { return whole_.has_sides(); }
    std::uint32_t part_count() const override { return static_cast<std::uint32_t>(reads_.size()); }
    void read(std::uint32_t number, const std::function<void(const Mesh&, const MeshPart*)>& visit) const override {
        ++reads_[number];
        MeshPart part = part_;
        part.number = number;
        visit(mesh_, &part);
    }
    CheckReport measure(const CheckOptions& options) const override { return whole_.measure(options); }
    /// By part: how many times it was read.
    const std::vector<int>& reads() const { return reads_; }

private:
    const ComparedMesh whole_;
    const Mesh& mesh_;
    MeshPart part_;
    mutable std::vector<int> reads_;
};

/// Slabs along x, `width` wide.
DividedMesh::PartOf slabs(double width) {
    return [width](Vec3 p) { return static_cast<std::uint32_t>(std::max(0.0, p.x) / width); };
}

/// Parts that lie anywhere, all in the same box.
std::uint32_t scattered(Vec3 p) { return static_cast<std::uint32_t>(std::floor(97 * (p.x + 3 * p.y + 7 * p.z))) % 5; }

const CompareOptions kFewSamples{.samples = 20000, .background = {}, .threads = 1};

Reconstruction grains(double reduce) {
    return test::run(test::grain_volume({14, 13, 12}, 12, 5), test::reduced(reduce));
}

void expect_near(const std::optional<DistanceStatistics>& found, const std::optional<DistanceStatistics>& expected,
                 double tolerance) {
    ASSERT_EQ(found.has_value(), expected.has_value());
    if (!found) return;
    EXPECT_EQ(found->samples, expected->samples);
    EXPECT_NEAR(found->rms, expected->rms, tolerance * expected->rms);
    EXPECT_NEAR(found->mean, expected->mean, tolerance * expected->mean);
    EXPECT_NEAR(found->max, expected->max, tolerance * expected->max);
    EXPECT_NEAR(found->quantile_95, expected->quantile_95, tolerance * expected->quantile_95);
}

/// Measures, counts of samples, and distances from A, whose samples are the same, to B in other parts.
void expect_same_from_a(const CompareReport& found, const CompareReport& expected) {
    constexpr double kRounding = 1e-13;
    expect_near(found.distance.a_to_b, expected.distance.a_to_b, kRounding);
    ASSERT_EQ(found.regions.size(), expected.regions.size());
    for (std::size_t n = 0; n < expected.regions.size(); ++n)
        expect_near(found.regions[n].distance.a_to_b, expected.regions[n].distance.a_to_b, kRounding);
    const auto compare_strata = [&](const auto& some, const auto& others) {
        ASSERT_EQ(some.size(), others.size());
        for (std::size_t n = 0; n < others.size(); ++n) {
            EXPECT_EQ(some[n].labels, others[n].labels);
            for (int side = 0; side < 2; ++side) {
                ASSERT_EQ(some[n].measures[side].has_value(), others[n].measures[side].has_value());
                const double expected_measure = others[n].measures[side].value_or(0);
                EXPECT_NEAR(some[n].measures[side].value_or(0), expected_measure, 1e-12 * expected_measure);
            }
            expect_near(some[n].distance.a_to_b, others[n].distance.a_to_b, kRounding);
            ASSERT_EQ(some[n].distance.b_to_a.has_value(), others[n].distance.b_to_a.has_value());
            if (!others[n].distance.b_to_a) continue;
            EXPECT_EQ(some[n].distance.b_to_a->samples, others[n].distance.b_to_a->samples);
        }
    };
    compare_strata(found.interfaces, expected.interfaces);
    compare_strata(found.lines, expected.lines);
}

TEST(CompareParts, distances_to_a_divided_model_are_those_to_the_whole) {
    const Reconstruction full = grains(0), model = grains(0.8);
    const ComparedMesh a{full.mesh, full.labels}, b{model.mesh, model.labels};
    // Samples of B differ. Their mean has a standard error of less than 1 %.
    CompareOptions options = kFewSamples;
    options.samples = 200000;
    const CompareReport whole = compare(a, b, options);
    EXPECT_GT(whole.distance.a_to_b->rms, 0.01);
    EXPECT_GT(whole.lines.size(), 20u);
    for (const DividedMesh& divided :
         {DividedMesh(model.mesh, model.labels, 5, slabs(3)), DividedMesh(model.mesh, model.labels, 5, scattered)}) {
        const CompareReport parts = compare(a, divided, options);
        expect_same_from_a(parts, whole);
        EXPECT_NEAR(parts.distance.b_to_a->rms, whole.distance.b_to_a->rms, 0.03 * whole.distance.b_to_a->rms);
        EXPECT_NEAR(parts.distance.b_to_a->mean, whole.distance.b_to_a->mean, 0.03 * whole.distance.b_to_a->mean);
    }
}

TEST(CompareParts, samples_of_a_divided_model_are_spread_over_all_of_it) {
    const Reconstruction full = grains(0), model = grains(0.8);
    const ComparedMesh a{full.mesh, full.labels};
    const DividedMesh divided(model.mesh, model.labels, 5, slabs(3));
    const CompareReport itself = compare(divided, ComparedMesh(model.mesh, model.labels), kFewSamples);
    EXPECT_EQ(itself.distance.both->max, 0);
    for (const auto& line : itself.lines) EXPECT_EQ(line.distance.both->max, 0);
    // Far from a model at one end, samples are at the distance that they have along x.
    Mesh wall;
    for (const Vec3 p : {Vec3{-1, -1e6, -1e6}, Vec3{-1, 1e6, -1e6}, Vec3{-1, 0, 2e6}}) wall.add_vertex(p);
    wall.add_face(VertexId{0}, VertexId{1}, VertexId{2}, 0, 1);
    const ComparedMesh end{wall, full.labels};
    const CompareReport from_whole = compare(ComparedMesh(model.mesh, model.labels), end, kFewSamples),
                        from_parts = compare(divided, end, kFewSamples);
    expect_near(from_parts.distance.a_to_b, from_whole.distance.a_to_b, 0.01);
}

/// Two squares of regions 0 and 1, `apart` along x; the nearer one is of region 0.
Mesh two_squares(double apart, Label first, Label second) {
    Mesh mesh;
    for (const auto& [x, label] : {std::pair(0.0, first), std::pair(apart, second)}) {
        const std::uint32_t start = mesh.vertex_end();
        for (const Vec3 p : {Vec3{x, 0, 0}, Vec3{x + 1, 0, 0}, Vec3{x + 1, 1, 0}, Vec3{x, 1, 0}}) mesh.add_vertex(p);
        mesh.add_face(VertexId{start}, VertexId{start + 1}, VertexId{start + 2}, label, exterior(0));
        mesh.add_face(VertexId{start}, VertexId{start + 2}, VertexId{start + 3}, label, exterior(0));
    }
    return mesh;
}

TEST(CompareParts, a_region_is_found_in_a_part_far_away) {
    const LabelTable labels = test::labels_from({1, 2, 3});
    const Mesh a = two_squares(10, 0, 1), b = two_squares(10, 1, 2);
    const ComparedMesh from{a, labels};
    const DividedMesh to(b, labels, 12, slabs(1.5));
    const CompareReport report = compare(from, to, kFewSamples);
    ASSERT_EQ(report.regions.size(), 3u);
    EXPECT_EQ(report.distance.a_to_b->max, 0);
    EXPECT_FALSE(report.regions[0].distance.both) << "only A has it";
    EXPECT_FALSE(report.regions[2].distance.both) << "only B has it";
    EXPECT_NEAR(report.regions[1].distance.a_to_b->max, 10, 0.01);
    EXPECT_NEAR(report.regions[1].distance.a_to_b->mean, 9.5, 0.01);
    expect_same_from_a(report, compare(from, ComparedMesh(b, labels), kFewSamples));
}

TEST(CompareParts, a_part_that_no_sample_needs_is_not_searched) {
    const LabelTable labels = test::labels_from({1, 2});
    Mesh one = two_squares(100, 0, 0);
    for (std::uint32_t f = 2; f < 4; ++f) one.remove_face(FaceId{f});
    const Mesh both = two_squares(100, 0, 0);
    const auto reads_of_far_part = [&](const Mesh& a) {
        const DividedMesh b(both, labels, 3, slabs(50));
        const CompareReport report = compare(ComparedMesh(a, labels), b, kFewSamples);
        EXPECT_EQ(report.distance.a_to_b->max, 0);
        return b.reads()[2];
    };
    EXPECT_EQ(reads_of_far_part(one), 2) << "for sums, and for samples";
    EXPECT_EQ(reads_of_far_part(both), 3);
}

TEST(CompareParts, result_does_not_depend_on_threads) {
    const Reconstruction full = grains(0), model = grains(0.8);
    const DividedMesh a(full.mesh, full.labels, 5, slabs(3)), b(model.mesh, model.labels, 5, scattered);
    std::vector<std::string> texts;
    for (const std::uint32_t threads : {1, 2, 3})
        texts.push_back(compare_json(compare(a, b, {.samples = 30000, .background = {}, .threads = threads})));
    EXPECT_EQ(texts[0], texts[1]);
    EXPECT_EQ(texts[0], texts[2]);
}

}  // namespace
}  // namespace regionmesh
