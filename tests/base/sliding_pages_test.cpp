#include "base/sliding_pages.h"

#include <gtest/gtest.h>

#include <deque>
#include <string>

#include "base/hash.h"

namespace regionmesh {
namespace {

TEST(SlidingPages, does_what_a_deque_does) {
    for (std::uint64_t seed : {1, 2, 3}) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        SlidingPages<std::uint64_t> pages;
        std::deque<std::uint64_t> deque;
        std::uint32_t first = 0;
        std::uint64_t state = mix64(seed);
        for (int step = 0; step < 400; ++step) {
            state = mix64(state);
            const auto count = static_cast<std::uint32_t>(state >> 8) % 2000;
            if (state % 2 == 0) {
                for (std::uint32_t n = 0; n < count; ++n) {
                    pages.push_back(mix64(state + n));
                    deque.push_back(mix64(state + n));
                }
            } else {
                const std::uint32_t gone = std::min(count, static_cast<std::uint32_t>(deque.size()));
                first += gone;
                deque.erase(deque.begin(), deque.begin() + gone);
                pages.drop_before(first);
            }
            ASSERT_EQ(pages.first(), first);
            ASSERT_EQ(pages.end(), first + deque.size());
            for (std::uint32_t n = 0; n < deque.size(); n += 7) ASSERT_EQ(pages[first + n], deque[n]);
        }
    }
}

TEST(SlidingPages, grows_to_a_number_and_keeps_what_is_there) {
    SlidingPages<int> pages;
    pages.grow(8, 1);
    pages.drop_before(8);
    pages.grow(100'000, 3);
    EXPECT_EQ(pages.end(), 100'000u);
    EXPECT_EQ(pages[8], 3);
    pages[99'999] = 5;
    pages.grow(99'000, 7);
    EXPECT_EQ(pages[99'999], 5);
}

TEST(SlidingPages, holds_its_window_and_two_pages) {
    SlidingPages<std::uint32_t> pages;
    for (std::uint32_t n = 0; n < 1'000'000; ++n) {
        pages.push_back(n);
        if (n >= 50'000) pages.drop_before(n - 49'999);
        ASSERT_LE(pages.bytes(), 50'000 * sizeof(std::uint32_t) + (32 << 10));
    }
    pages.drop_before(pages.end());
    EXPECT_LE(pages.bytes(), std::size_t{16 << 10});
}

}  // namespace
}  // namespace regionmesh
