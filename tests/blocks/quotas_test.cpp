#include "blocks/quotas.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "blocks/simplify_block.h"

namespace regionmesh {
namespace {

/// A block whose sample keeps `first` at the first trial and the power `slope` of the threshold from there.
PieceHeader block(std::uint64_t faces, double first, double slope) {
    PieceHeader header;
    header.faces = faces;
    for (int n = 0; n < 6; ++n) header.left[n] = first * std::pow(trial_threshold(n) / trial_threshold(0), slope);
    return header;
}

double kept(const std::vector<PieceHeader>& blocks, const std::vector<double>& shares) {
    double sum = 0;
    for (std::size_t n = 0; n < blocks.size(); ++n) sum += static_cast<double>(blocks[n].faces) * shares[n];
    return sum;
}

TEST(Quotas, take_more_from_blocks_whose_collapses_cost_less) {
    const std::vector<PieceHeader> blocks{block(1000, 0.9, -0.1), block(1000, 0.3, -0.1), block(0, 1, 0)};
    for (const double target : {1900.0, 1100.0, 700.0, 300.0}) {
        const std::vector<double> shares = shares_at_target(blocks, target);
        EXPECT_NEAR(kept(blocks, shares), target, 1) << target;
        EXPECT_GT(shares[0], shares[1]);
    }
    // At one threshold the first keeps three times as much as the second, beyond the first trial.
    const std::vector<double> shares = shares_at_target(blocks, 600);
    EXPECT_NEAR(shares[0] / shares[1], 3, 1e-6);
}

TEST(Quotas, keep_all_where_the_target_is_all) {
    const std::vector<PieceHeader> blocks{block(1000, 0.9, -0.1), block(500, 0.2, -0.3)};
    EXPECT_NEAR(kept(blocks, shares_at_target(blocks, 1500)), 1500, 1);
}

std::uint64_t sum(const std::vector<std::uint64_t>& faces) {
    return std::accumulate(faces.begin(), faces.end(), std::uint64_t{0});
}

TEST(Quotas, trim_takes_the_excess_out_of_few_blocks) {
    const std::vector<std::uint64_t> faces{100000, 20, 300000, 0, 70000};
    const std::vector<bool> limits{false, false, true, false, false};
    const std::uint64_t all = sum(faces);
    EXPECT_EQ(trimmed(faces, limits, all), faces);
    EXPECT_EQ(trimmed(faces, limits, all - 900), (std::vector<std::uint64_t>{99100, 20, 300000, 0, 70000}));
    // Two blocks: the first may end two below its goal, so that the second has two less to give.
    EXPECT_EQ(trimmed(faces, limits, all - 1100), (std::vector<std::uint64_t>{99000, 20, 300000, 0, 69902}));
    EXPECT_EQ(sum(trimmed(faces, limits, 0)), all - 1000 - 700 - 20);
    EXPECT_EQ(trimmed(faces, std::vector<bool>(5, true), 100), faces);
}

}  // namespace
}  // namespace regionmesh
