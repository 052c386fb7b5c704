#include "check/nesting_ray.h"

#include <gtest/gtest.h>

#include <vector>

namespace regionmesh {
namespace {

constexpr Vec3 kFrom{3, -2, 5};
constexpr double kReach = 100;

bool holds(const Box& box, Vec3 p) { return max(p, box.low) == p && min(p, box.high) == p; }

TEST(NestingRay, is_searched_in_pieces_without_gaps_up_to_its_end) {
    std::vector<Box> pieces;
    search_along(kFrom, kReach, {}, [&](const Box& piece) { pieces.push_back(piece); });
    ASSERT_GT(pieces.size(), 3u);
    EXPECT_EQ(pieces.front().low, kFrom);
    for (std::size_t n = 1; n < pieces.size(); ++n) EXPECT_EQ(pieces[n].low, pieces[n - 1].high);
    EXPECT_EQ(pieces.back().high, kFrom + kReach * kNestingRay);
}

TEST(NestingRay, is_searched_up_to_the_piece_with_the_nearest_hit) {
    for (const double distance : {0.01, 0.3, 7.0, 63.0, 99.9}) {
        NestingHit nearest;
        std::vector<Box> pieces;
        search_along(kFrom, kReach, nearest, [&](const Box& piece) {
            pieces.push_back(piece);
            // A face that reaches into an earlier piece is found there.
            if (holds(piece, kFrom + distance / 2 * kNestingRay)) nearest.distance = distance;
        });
        EXPECT_TRUE(holds(pieces.back(), kFrom + distance * kNestingRay)) << distance;
    }
}

TEST(NestingRay, is_not_searched_beyond_a_hit_that_is_known) {
    int count = 0;
    search_along(kFrom, kReach, {.distance = 0.2, .label = 1}, [&](const Box&) { ++count; });
    EXPECT_EQ(count, 1);
}

}  // namespace
}  // namespace regionmesh
