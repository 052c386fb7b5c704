#include "blocks/quotas.h"

#include <gtest/gtest.h>

#include <cmath>

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

TEST(Quotas, the_threshold_takes_more_from_blocks_whose_collapses_cost_less) {
    // Of 1000 faces each, 0.9 and 0.3 are left at the first trial.
    const std::vector<PieceHeader> blocks{block(1000, 0.9, -0.1), block(1000, 0.3, -0.1), block(0, 1, 0)};
    EXPECT_NEAR(threshold_at(blocks, 1200), trial_threshold(0), 1e-9);
    EXPECT_NEAR(threshold_at(blocks, 1200 * std::pow(2, -0.1)), 2 * trial_threshold(0), 1e-9);
    // Before the first trial, from all faces at no cost; beyond the last by the same power.
    EXPECT_NEAR(threshold_at(blocks, 1600), trial_threshold(0) / 2, 1e-9);
    EXPECT_NEAR(threshold_at(blocks, 1200 * std::pow(4, -0.7)) / trial_threshold(7), 1, 1e-9);
}

TEST(Quotas, shares_leave_the_target_in_all) {
    const std::vector<PieceHeader> blocks{block(1000, 0.9, -0.1), block(1000, 0.3, -0.1), block(0, 1, 0)};
    for (const double target : {2000.0, 1900.0, 1100.0, 600.0, 300.0}) {
        const std::vector<double> shares = shares_at(blocks, target);
        EXPECT_NEAR(1000 * shares[0] + 1000 * shares[1], target, 1) << target;
        if (target < 2000) {
            EXPECT_GT(shares[0], shares[1]);
        }
        if (target <= 1200) {
            EXPECT_NEAR(shares[0] / shares[1], 3, 1e-6) << "at one threshold";
        }
    }
}

}  // namespace
}  // namespace regionmesh
