#include "judge/try_together.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>

namespace regionmesh {
namespace {

using testing::ElementsAre;

/// Looks at a number and the two beside it, and changes the number.
struct Trial {
    Box box = {};
    int seen = 0;
};

Box box_round(double at) { return {{at - 1, 0, 0}, {at + 1, 0, 0}}; }

TEST(TryTogether, leaves_out_what_lies_near_an_earlier_change) {
    std::vector<Trial> trials(6);
    const std::vector<double> places{0, 1.5, 10, 11.5, 12.5, 20};
    const std::vector<bool> changes{true, true, false, true, true, true};
    std::vector<std::uint32_t> settled;
    try_together(
        std::span(trials), 2, [&](std::uint32_t n) { trials[n].box = box_round(places[n]); },
        [&](std::uint32_t n) {
            settled.push_back(n);
            return changes[n];
        });
    EXPECT_THAT(settled, ElementsAre(0, 2, 3, 5)) << "1 lies near 0, 4 near 3; 2 has changed nothing";
}

TEST(TryTogether, all_numbers_of_stripes_are_settled_once_and_none_was_tested_before_a_change_near_it) {
    for (const std::uint32_t size : {0u, 1u, 7u, 100u, 1000u})
        for (const std::uint32_t threads : {1u, 2u, 5u}) {
            std::vector<int> values(size + 2, 1), settled(size, 0);
            const auto sum_near = [&](std::uint32_t n) { return values[n] + values[n + 1] + values[n + 2]; };
            try_in_stripes(
                size, threads, Trial{},
                [&](std::uint32_t n, Trial& trial) {
                    trial.box = box_round(n);
                    trial.seen = sum_near(n);
                },
                [&](std::uint32_t n, const Trial& trial) {
                    EXPECT_EQ(trial.seen, sum_near(n));
                    ++settled[n];
                    values[n + 1] = 2;
                    return true;
                });
            EXPECT_EQ(std::accumulate(settled.begin(), settled.end(), 0u), size);
            EXPECT_EQ(std::count(settled.begin(), settled.end(), 1), size);
        }
}

TEST(TryTogether, stripes_lie_side_by_side) {
    std::vector<std::uint32_t> order;
    const std::uint32_t size = 3 * kLeastOfStripe;
    try_in_stripes(
        size, 1, Trial{}, [](std::uint32_t n, Trial& trial) { trial.box = box_round(n); },
        [&](std::uint32_t n, const Trial&) {
            order.push_back(n);
            return false;
        });
    ASSERT_EQ(order.size(), size);
    for (std::uint32_t n = 0; n < size; ++n) EXPECT_EQ(order[n], n % 3 * kLeastOfStripe + n / 3);
}

}  // namespace
}  // namespace regionmesh
