#include "compare/sample.h"

#include <gtest/gtest.h>

#include "support/shapes.h"

namespace regionmesh {
namespace {

/// A square of side 2 and one of side 1, with different labels, and faces without area.
Mesh two_squares() {
    return test::shape(
        {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {5, 0, 0}, {6, 0, 0}, {6, 1, 0}, {5, 1, 0}},
        {{{0, 1, 2}}, {{0, 2, 3}}, {{4, 5, 6}, 0, 2}, {{4, 6, 7}, 0, 2}, {{4, 4, 5}, 1, 2}, {{4, 5, 5}, 1, 2}});
}

SortedStrata strata_of(const Mesh& mesh) {
    LabelTable table;
    for (InputLabel label : {0, 1, 2}) table.dense(label);
    const CommonLabels labels(table, table);
    return interfaces_of({mesh, labels, 0, {}}, 1);
}

TEST(Samples, are_shared_out_by_area) {
    const SortedStrata strata = strata_of(two_squares());
    ASSERT_EQ(strata.strata.size(), 3u);
    const Samples samples(strata, 5000, 1);
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
        const Samples samples(strata, count, 1);
        for (const std::uint32_t stratum : {0, 1}) {
            const std::uint64_t n = samples.end(stratum) - samples.begin(stratum);
            EXPECT_GE(n, 1u);
            EXPECT_DOUBLE_EQ(samples.weight(stratum) * static_cast<double>(n), stratum == 0 ? 4 : 1);
        }
    }
}

TEST(Samples, lie_on_their_stratum_and_are_spread_evenly) {
    const SortedStrata strata = strata_of(two_squares());
    const Samples samples(strata, 40000, 1);
    Vec3 sum;
    std::array<int, 16> cells{};
    samples.for_range(samples.begin(0), samples.end(0), [&](std::uint64_t, std::uint32_t stratum, Vec3 p) {
        EXPECT_EQ(stratum, 0u);
        EXPECT_TRUE(p.x >= 0 && p.x <= 2 && p.y >= 0 && p.y <= 2 && p.z == 0);
        sum += p;
        ++cells[std::min(int(2 * p.x), 3) * 4 + std::min(int(2 * p.y), 3)];
    });
    EXPECT_NEAR(sum.x / 32000, 1, 0.01);
    EXPECT_NEAR(sum.y / 32000, 1, 0.01);
    for (const int count : cells) EXPECT_NEAR(count, 2000, 200);
}

TEST(Samples, are_the_same_from_wherever_one_begins) {
    const SortedStrata strata = strata_of(two_squares());
    const Samples samples(strata, 1000, 1);
    std::vector<Vec3> whole, parts;
    samples.for_range(0, samples.size(), [&](std::uint64_t, std::uint32_t, Vec3 p) { whole.push_back(p); });
    for (std::uint64_t first = 0; first < samples.size(); first += 7)
        samples.for_range(first, std::min(first + 7, samples.size()), [&](std::uint64_t n, std::uint32_t, Vec3 p) {
            EXPECT_EQ(n, parts.size());
            parts.push_back(p);
        });
    EXPECT_EQ(whole, parts);
}

TEST(Samples, of_edges_are_shared_out_by_length) {
    // Three squares that meet in an edge of length 3.
    const Mesh book = test::shape({{0, 0, 0}, {3, 0, 0}, {0, 1, 0}, {0, -1, 1}, {0, -1, -1}},
                                  {{{0, 1, 2}, 0, 1}, {{0, 1, 3}, 1, 2}, {{0, 1, 4}, 2, 0}});
    LabelTable table;
    for (InputLabel label : {0, 1, 2}) table.dense(label);
    const CommonLabels labels(table, table);
    const SortedStrata lines = lines_of({book, labels, 0, {}}, true, 1);
    ASSERT_EQ(lines.strata.size(), 1u);
    EXPECT_EQ(lines.strata[0].labels, (std::vector<Label>{0, 1, 2}));
    const Samples samples(lines, 3000, 1);
    EXPECT_EQ(samples.measure(0), 3);
    std::array<int, 3> thirds{};
    samples.for_range(0, samples.size(), [&](std::uint64_t, std::uint32_t, Vec3 p) {
        EXPECT_EQ(p.y, 0);
        ++thirds[std::min(int(p.x), 2)];
    });
    for (const int count : thirds) EXPECT_NEAR(count, 1000, 100);
}

}  // namespace
}  // namespace regionmesh
