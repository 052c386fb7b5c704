#include "base/sliding_array.h"

#include <gtest/gtest.h>

#include <deque>

#include "base/hash.h"

namespace regionmesh {
namespace {

TEST(SlidingArray, elements_keep_their_numbers) {
    SlidingArray<std::uint64_t> array;
    for (std::uint32_t n = 0; n < 100; ++n) array.push_back(mix64(n));
    for (std::uint32_t first : {1u, 10u, 60u, 60u, 99u}) {
        array.drop_before(first);
        EXPECT_EQ(array.first(), first);
        EXPECT_EQ(array.end(), 100u);
        for (std::uint32_t n = first; n < 100; ++n) EXPECT_EQ(array[n], mix64(n));
    }
    array.push_back(7);
    EXPECT_EQ(array[100], 7u);
}

TEST(SlidingArray, may_be_let_go_whole_and_go_on) {
    SlidingArray<int> array;
    array.drop_before(0);
    for (int n = 0; n < 5; ++n) array.push_back(n);
    array.drop_before(5);
    EXPECT_EQ(array.first(), array.end());
    EXPECT_EQ(array.bytes(), 0u);
    array.push_back(42);
    EXPECT_EQ(array[5], 42);
    EXPECT_EQ(array.end(), 6u);
}

TEST(SlidingArray, grows_to_a_number_and_keeps_what_is_there) {
    SlidingArray<int> array;
    for (int n = 0; n < 8; ++n) array.push_back(n);
    array.drop_before(6);
    array.grow(10, 3);
    EXPECT_EQ(array.end(), 10u);
    EXPECT_EQ(array[7], 7);
    EXPECT_EQ(array[8], 3);
    EXPECT_EQ(array[9], 3);
}

TEST(SlidingArray, holds_little_more_than_its_window) {
    SlidingArray<std::uint32_t> array;
    for (std::uint32_t n = 0; n < 100000; ++n) {
        array.push_back(n);
        if (n >= 1000) array.drop_before(n - 999);
    }
    EXPECT_LE(array.bytes(), 1000 * 4 * 4 / 3 + 4u);
}

TEST(SlidingArray, does_what_a_deque_does) {
    for (std::uint64_t seed : {1, 2, 3}) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        SlidingArray<std::uint64_t> array;
        std::deque<std::uint64_t> mesh;
        std::uint32_t first = 0;
        std::uint64_t state = mix64(seed);
        for (int step = 0; step < 2000; ++step) {
            state = mix64(state);
            if (state % 5 != 0) {
                array.push_back(state);
                mesh.push_back(state);
            } else {
                const std::uint32_t gone = (state >> 8) % 12;
                const std::uint32_t count = std::min<std::uint32_t>(gone, static_cast<std::uint32_t>(mesh.size()));
                first += count;
                mesh.erase(mesh.begin(), mesh.begin() + count);
                array.drop_before(first);
            }
            ASSERT_EQ(array.first(), first);
            ASSERT_EQ(array.end(), first + mesh.size());
            for (std::uint32_t n = 0; n < mesh.size(); ++n) ASSERT_EQ(array[first + n], mesh[n]);
        }
    }
}

}  // namespace
}  // namespace regionmesh
