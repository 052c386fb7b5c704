#include "cells/label_census.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "regionmesh/census.h"
#include "support/runs.h"

namespace regionmesh {
namespace {

/// What the oracle says, straight from its definition: every simplex of the lattice is looked at.
struct PlainCount {
    std::map<InputLabel, std::int64_t> euler;
    std::uint64_t quadruple_points = 0;
    std::set<std::pair<InputLabel, InputLabel>> pairs;
};

void count_simplices_at(const test::ArrayVolume& volume, const test::Size& at, PlainCount& count) {
    for (const SimplexKind& kind : kKinds) {
        std::set<InputLabel> labels;
        for (int n = 0; n < kind.node_count; ++n) {
            test::Size node = at;
            for (int axis = 0; axis < 3; ++axis) node[axis] += kind.steps[n] >> axis & 1;
            if (node[0] == volume.size()[0] || node[1] == volume.size()[1] || node[2] == volume.size()[2]) break;
            labels.insert(volume.at(node[0], node[1], node[2]));
            if (n + 1 < kind.node_count) continue;
            if (labels.size() == 1) count.euler[*labels.begin()] += kind.node_count % 2 ? 2 : -2;
            if (labels.size() == 4) ++count.quadruple_points;
            if (labels.size() == 2 && kind.node_count == 2) count.pairs.insert({*labels.begin(), *labels.rbegin()});
        }
    }
}

PlainCount count_simplices(const test::ArrayVolume& volume) {
    PlainCount count;
    for (std::uint32_t z = 0; z < volume.size()[2]; ++z)
        for (std::uint32_t y = 0; y < volume.size()[1]; ++y)
            for (std::uint32_t x = 0; x < volume.size()[0]; ++x) count_simplices_at(volume, {x, y, z}, count);
    return count;
}

void expect_plain_count(const test::ArrayVolume& volume, const Census& census) {
    const PlainCount expected = count_simplices(volume);
    EXPECT_EQ(census.oracle.quadruple_points_inside, expected.quadruple_points);
    EXPECT_EQ(census.oracle.region_pairs, expected.pairs.size());
    for (const auto& [label, euler] : expected.euler)
        for (Label dense = 0; dense < census.labels.size(); ++dense) {
            if (census.labels.input(dense) != label) continue;
            EXPECT_EQ(census.oracle.euler[dense], euler) << "label " << label;
        }
}

std::vector<test::ArrayVolume> volumes() {
    return {test::noise_volume({5, 4, 6}, 2, 1),  test::noise_volume({6, 6, 6}, 4, 2),
            test::noise_volume({4, 7, 5}, 90, 3), test::grain_volume({9, 8, 10}, 5, 4),
            test::ball_volume({9, 9, 9}, 3.2),    test::solid_volume({2, 3, 4})};
}

TEST(LabelCensus, oracle_is_the_definition_summed_over_the_lattice) {
    for (test::ArrayVolume& volume : volumes())
        for (const Sweep& sweep : {kSweepX, kSweepY, kSweepZ}) {
            volume.swept(sweep).rewind();
            expect_plain_count(volume, count_labels(volume, {.background = {}}));
        }
}

TEST(LabelCensus, counts_the_faces_that_are_made) {
    std::vector<ReconstructOptions> options(4, test::plain());
    options[1].cap = false;
    options[2].background = {0};
    options[3].background = {0, 1, 77};
    for (test::ArrayVolume& volume : volumes())
        for (const ReconstructOptions& option : options) {
            volume.rewind();
            const Census census =
                count_labels(volume, {.cap = option.cap, .background = option.background, .cells = option.cells});
            EXPECT_EQ(census.face_count, test::run(volume, option).mesh.face_count());
        }
}

TEST(LabelCensus, counts_the_same_on_two_threads) {
    for (test::ArrayVolume& volume : volumes()) {
        const Census one = count_labels(volume, {});
        volume.rewind();
        const Census two = count_labels(volume, {.threads = 2});
        EXPECT_EQ(one.samples, two.samples);
        EXPECT_EQ(one.strip_faces, two.strip_faces);
        EXPECT_EQ(one.face_count, two.face_count);
        EXPECT_EQ(one.oracle.euler, two.oracle.euler);
        EXPECT_EQ(one.oracle.region_pairs, two.oracle.region_pairs);
        EXPECT_EQ(one.oracle.quadruple_points_inside, two.oracle.quadruple_points_inside);
    }
}

TEST(LabelCensus, counts_the_samples_of_each_label) {
    test::TextVolume volume({{"112", "122"}, {"111", "113"}});
    const Census census = count_labels(volume, {.background = {}});
    ASSERT_EQ(census.labels.size(), 3u);
    EXPECT_EQ(census.samples, (std::vector<std::uint64_t>{8, 3, 1}));
}

TEST(LabelCensus, knows_a_ball_a_shell_and_a_torus) {
    const auto euler_of_one = [](test::ArrayVolume volume) {
        const Census census = count_labels(volume, {});
        return census.oracle.euler.at(1);
    };
    EXPECT_EQ(euler_of_one(test::ball_volume({9, 9, 9}, 3)), 2);
    EXPECT_EQ(euler_of_one(test::TextVolume({{"000", "000", "000"}, {"111", "101", "111"}, {"000", "000", "000"}})), 0);
    EXPECT_EQ(euler_of_one(test::TextVolume({{"111", "111", "111"}, {"111", "101", "111"}, {"111", "111", "111"}})), 4);
}

}  // namespace
}  // namespace regionmesh
