#include "compare/sample.h"

#include <gtest/gtest.h>

#include <numeric>
#include <span>

#include "support/labels.h"
#include "support/shapes.h"

namespace regionmesh {
namespace {

/// A square of side 2 and one of side 1, with different labels, and faces without area.
Mesh two_squares() {
    return test::shape(
        {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {5, 0, 0}, {6, 0, 0}, {6, 1, 0}, {5, 1, 0}},
        {{{0, 1, 2}}, {{0, 2, 3}}, {{4, 5, 6}, 0, 2}, {{4, 6, 7}, 0, 2}, {{4, 4, 5}, 1, 2}, {{4, 5, 5}, 1, 2}});
}

LabelTable labels() { return test::labels_from({0, 1, 2}); }

SortedStrata strata_of(const Mesh& mesh) {
    const LabelTable table = labels();
    const CommonLabels common(table, table);
    return interfaces_of({mesh, common, 0, {}}, 1);
}

Samples samples_on(const SortedStrata& strata, std::uint64_t count) {
    std::vector<double> measures;
    for (const Stratum& stratum : strata.strata) measures.push_back(strata.measure(stratum));
    return {measures, count};
}

/// The points of all samples, on parts that all have the strata of the first.
std::vector<Vec3> points_on(const std::vector<SortedStrata>& parts, const Samples& samples) {
    SamplePoints points(samples);
    std::vector<std::uint32_t> numbers(parts.front().strata.size());
    std::iota(numbers.begin(), numbers.end(), 0);
    for (const SortedStrata& part : parts) points.add(part, numbers, 1);
    return points.take();
}

TEST(Samples, are_shared_out_by_area) {
    const SortedStrata strata = strata_of(two_squares());
    ASSERT_EQ(strata.strata.size(), 3u);
    const Samples samples = samples_on(strata, 5000);
    EXPECT_EQ(samples.end(0) - samples.begin(0), 4000u);
    EXPECT_EQ(samples.end(1) - samples.begin(1), 1000u);
    EXPECT_EQ(samples.end(2) - samples.begin(2), 0u) << "no area, no sample";
    EXPECT_EQ(samples.size(), 5000u);
    EXPECT_DOUBLE_EQ(samples.measure(0), 4);
    EXPECT_DOUBLE_EQ(samples.weight(0), 0.001);
}

TEST(Samples, every_stratum_with_area_has_some) {
    const SortedStrata strata = strata_of(two_squares());
    for (const std::uint64_t count : {0, 1, 10, 400}) {
        const Samples samples = samples_on(strata, count);
        for (const std::uint32_t stratum : {0, 1}) {
            const std::uint64_t n = samples.end(stratum) - samples.begin(stratum);
            EXPECT_GE(n, 1u);
            EXPECT_DOUBLE_EQ(samples.weight(stratum) * static_cast<double>(n), stratum == 0 ? 4 : 1);
        }
    }
}

TEST(Samples, lie_on_their_stratum_and_are_spread_evenly) {
    const SortedStrata strata = strata_of(two_squares());
    const Samples samples = samples_on(strata, 40000);
    const std::vector<Vec3> points = points_on({strata}, samples);
    Vec3 sum;
    std::array<int, 16> cells{};
    for (const Vec3& p : std::span(points).first(samples.end(0))) {
        EXPECT_TRUE(p.x >= 0 && p.x <= 2 && p.y >= 0 && p.y <= 2 && p.z == 0);
        sum += p;
        ++cells[std::min(int(2 * p.x), 3) * 4 + std::min(int(2 * p.y), 3)];
    }
    EXPECT_NEAR(sum.x / 32000, 1, 0.01);
    EXPECT_NEAR(sum.y / 32000, 1, 0.01);
    for (const int count : cells) EXPECT_NEAR(count, 2000, 200);
}

TEST(Samples, lie_in_the_parts_of_a_model_in_turn) {
    const Mesh mesh = two_squares();
    const LabelTable table = labels();
    const CommonLabels common(table, table);
    std::vector<SortedStrata> parts;
    for (const std::uint32_t number : {0, 1}) {
        const MeshPart part{.number = number,
                            .of_vertex = std::vector<std::uint32_t>(mesh.vertex_end()),
                            .of_face = {0, 1, 1, 0, 0, 1},
                            .low_of_face = {},
                            .key_of_face = {}};
        parts.push_back(interfaces_of({mesh, common, 0, {}, &part}, 1));
    }
    const Samples samples = samples_on(strata_of(mesh), 5000);
    const std::vector<Vec3> points = points_on(parts, samples);
    ASSERT_EQ(points.size(), 5000u);
    for (std::uint64_t n = 0; n < 4000; ++n)
        EXPECT_EQ(points[n].x > points[n].y, n < 2000) << n << " of the first face";
    for (std::uint64_t n = 4000; n < 5000; ++n)
        EXPECT_EQ(points[n].x - 5 < points[n].y, n < 4500) << n << ": the second face of the other square is first";
    for (const Vec3& p : points) EXPECT_TRUE(p != Vec3{}) << "a sample without a place";
}

TEST(Samples, of_edges_are_shared_out_by_length) {
    // Three squares that meet in an edge of length 3.
    const Mesh book = test::shape({{0, 0, 0}, {3, 0, 0}, {0, 1, 0}, {0, -1, 1}, {0, -1, -1}},
                                  {{{0, 1, 2}, 0, 1}, {{0, 1, 3}, 1, 2}, {{0, 1, 4}, 2, 0}});
    const LabelTable table = labels();
    const CommonLabels common(table, table);
    const SortedStrata lines = lines_of({book, common, 0, {}}, true, 1);
    ASSERT_EQ(lines.strata.size(), 1u);
    EXPECT_EQ(lines.strata[0].labels, (std::vector<Label>{0, 1, 2}));
    const Samples samples = samples_on(lines, 3000);
    EXPECT_EQ(samples.measure(0), 3);
    std::array<int, 3> thirds{};
    for (const Vec3& p : points_on({lines}, samples)) {
        EXPECT_EQ(p.y, 0);
        ++thirds[std::min(int(p.x), 2)];
    }
    for (const int count : thirds) EXPECT_NEAR(count, 1000, 100);
}

}  // namespace
}  // namespace regionmesh
