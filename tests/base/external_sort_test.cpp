#include "base/external_sort.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "regionmesh/error.h"
#include "support/random.h"

namespace regionmesh {
namespace {

/// Least that is held, however little was allowed: so many numbers make a run.
constexpr std::uint64_t kRun = 1024;

std::vector<std::uint32_t> random_numbers(std::size_t count, std::uint32_t below, std::uint64_t seed) {
    test::Random random(seed);
    std::vector<std::uint32_t> numbers(count);
    for (std::uint32_t& n : numbers) n = random.below(below);
    return numbers;
}

template <class Item>
std::vector<Item> rest_of(ExternalSort<Item>& sort) {
    std::vector<Item> items;
    for (Item item{}; sort.next(item);) items.push_back(item);
    return items;
}

TEST(ExternalSort, any_number_of_runs_comes_out_in_order) {
    for (std::size_t count : {std::size_t{1}, kRun - 1, kRun, kRun + 1, 2 * kRun, 2 * kRun + 1, 50 * kRun + 17}) {
        SCOPED_TRACE(std::to_string(count) + " items");
        std::vector<std::uint32_t> numbers = random_numbers(count, 1u << 30, count);
        ExternalSort<std::uint32_t> sort(1);
        for (std::uint32_t n : numbers) sort.add(n);
        EXPECT_EQ(sort.size(), count);
        sort.finish();
        std::sort(numbers.begin(), numbers.end());
        EXPECT_EQ(rest_of(sort), numbers);
    }
}

TEST(ExternalSort, memory_does_not_matter_to_what_comes_out) {
    std::vector<std::uint32_t> numbers = random_numbers(20 * kRun, 100, 5);
    std::vector<std::uint32_t> sorted = numbers;
    std::sort(sorted.begin(), sorted.end());
    for (std::uint64_t bytes : {std::uint64_t{0}, std::uint64_t{10000}, std::uint64_t{1} << 30}) {
        ExternalSort<std::uint32_t> sort(bytes);
        for (std::uint32_t n : numbers) sort.add(n);
        sort.finish();
        EXPECT_EQ(rest_of(sort), sorted);
    }
}

TEST(ExternalSort, rewind_begins_with_the_least_again_wherever_it_was) {
    for (std::size_t count : {std::size_t{100}, 10 * kRun + 1}) {
        std::vector<std::uint32_t> numbers = random_numbers(count, 1000, 6);
        ExternalSort<std::uint32_t> sort(0);
        for (std::uint32_t n : numbers) sort.add(n);
        sort.finish();
        std::sort(numbers.begin(), numbers.end());
        for (std::size_t taken : {std::size_t{0}, std::size_t{1}, count / 2, count}) {
            std::uint32_t item = 0;
            for (std::size_t n = 0; n < taken; ++n) ASSERT_TRUE(sort.next(item));
            sort.rewind();
            EXPECT_EQ(rest_of(sort), numbers);
            EXPECT_FALSE(sort.next(item)) << "after the end it is at its end";
            sort.rewind();
        }
    }
}

TEST(ExternalSort, nothing_comes_out_where_nothing_went_in) {
    ExternalSort<std::uint32_t> sort(1 << 20);
    sort.finish();
    EXPECT_EQ(sort.size(), 0u);
    EXPECT_TRUE(rest_of(sort).empty());
    sort.rewind();
    EXPECT_TRUE(rest_of(sort).empty());
}

TEST(ExternalSort, sort_that_was_moved_goes_on) {
    std::vector<std::uint32_t> numbers = random_numbers(5 * kRun, 1000, 7);
    ExternalSort<std::uint32_t> before(0);
    for (std::uint32_t n : numbers) before.add(n);
    before.finish();
    ExternalSort<std::uint32_t> sort(std::move(before));
    std::sort(numbers.begin(), numbers.end());
    EXPECT_EQ(rest_of(sort), numbers);
}

TEST(ExternalSort, items_are_compared_by_their_own_order_and_keep_what_goes_with_it) {
    struct Item {
        std::uint32_t key, value;
        bool operator<(const Item& other) const { return key < other.key; }
    };
    ExternalSort<Item> sort(0);
    const std::uint32_t count = 5000;
    for (std::uint32_t n = 0; n < count; ++n) sort.add({n * 7919 % count, n});
    sort.finish();
    std::uint32_t next = 0;
    for (Item item{}; sort.next(item); ++next) {
        ASSERT_EQ(item.key, next);
        ASSERT_EQ(item.value * 7919 % count, next);
    }
    EXPECT_EQ(next, count);
}

}  // namespace
}  // namespace regionmesh
