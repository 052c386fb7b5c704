#include "compare/statistics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace regionmesh {
namespace {

TEST(Statistics, of_a_hundred_equal_parts) {
    std::vector<double> distances;
    for (int n = 100; n > 0; --n) distances.push_back(n);
    const auto found = statistics_of({{distances, 2.0}});
    ASSERT_TRUE(found);
    EXPECT_EQ(found->samples, 100u);
    EXPECT_EQ(found->max, 100);
    EXPECT_DOUBLE_EQ(found->mean, 50.5);
    EXPECT_DOUBLE_EQ(found->rms, std::sqrt(3383.5));
    EXPECT_EQ(found->quantile_95, 95);
}

TEST(Statistics, weigh_each_part) {
    const std::vector<double> near{0, 0, 0}, far{1};
    const auto found = statistics_of({{near, 1.0}, {far, 9.0}});
    EXPECT_DOUBLE_EQ(found->mean, 0.75);
    EXPECT_DOUBLE_EQ(found->rms, std::sqrt(0.75));
    EXPECT_EQ(found->quantile_95, 1);
    EXPECT_EQ(statistics_of({{near, 10.0}, {far, 1.0}})->quantile_95, 0) << "30 of 31 parts are at 0";
}

TEST(Statistics, quantile_is_that_of_the_sorted_list) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> unit(0, 1);
    for (std::size_t size : {1, 2, 3, 19, 20, 21, 1000}) {
        std::vector<double> distances(size);
        for (double& distance : distances) distance = unit(random);
        const auto found = statistics_of({{distances, 0.5}});
        std::ranges::sort(distances);
        EXPECT_EQ(found->quantile_95, distances[static_cast<std::size_t>(std::ceil(0.95 * size - 1e-9)) - 1]) << size;
    }
}

TEST(Statistics, of_nothing_are_nothing) {
    EXPECT_FALSE(statistics_of({}));
    EXPECT_FALSE(statistics_of({{{}, 1.0}}));
}

}  // namespace
}  // namespace regionmesh
