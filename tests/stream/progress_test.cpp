// Progress over all stages: it rises to the end, while decimating, too.
#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "stream/progress_shares.h"
#include "support/runs.h"

namespace regionmesh {
namespace {

TEST(ProgressShares, rise_to_1_and_do_not_go_back) {
    ProgressShares shares;
    shares.leave_out(WorkStage::kImprove);
    EXPECT_EQ(shares.share(), 0);
    shares.advance(WorkStage::kMesh, 0.5);
    const double half = shares.share();
    EXPECT_GT(half, 0);
    shares.advance(WorkStage::kMesh, 0.2);
    EXPECT_EQ(shares.share(), half);
    for (int stage = 0; stage <= static_cast<int>(WorkStage::kSamples); ++stage)
        shares.advance(static_cast<WorkStage>(stage), 2);
    EXPECT_DOUBLE_EQ(shares.share(), 1);
}

TEST(Progress, rises_in_every_stage_up_to_the_end) {
    test::ArrayVolume volume = test::ball_volume({40, 40, 40}, 15);
    std::vector<double> shares;
    std::map<std::string, double> first;
    reconstruct(volume, {.reduce = 0.9, .improve = true, .threads = 1}, [&](const Progress& progress) {
        first.emplace(progress.stage, progress.share);
        shares.push_back(progress.share);
    });
    ASSERT_FALSE(shares.empty());
    EXPECT_TRUE(std::ranges::is_sorted(shares));
    EXPECT_EQ(shares.front(), 0);
    EXPECT_GT(shares.back(), 0.97);
    EXPECT_LT(first.at("count"), first.at("decimate"));
    EXPECT_LT(first.at("decimate"), first.at("improve"));
    EXPECT_LT(first.at("improve"), first.at("check"));
}

TEST(Progress, rises_while_tiles_are_decimated_after_the_last_strip) {
    test::ArrayVolume volume = test::ball_volume({48, 48, 48}, 20);
    std::vector<double> shares;
    reconstruct(volume, {.reduce = 0.9, .threads = 1}, [&](const Progress& progress) {
        const bool is_read = progress.strips_read == progress.strip_count;
        if (is_read && progress.stage == std::string("reconstruct")) shares.push_back(progress.share);
    });
    ASSERT_GT(shares.size(), 2u);
    EXPECT_GT(shares.back(), shares.front() + 0.1);
}

}  // namespace
}  // namespace regionmesh
