// FlatArray, UnionFind, radix_sort, hashes.
#include <gtest/gtest.h>

#include <algorithm>

#include "base/hash.h"
#include "base/radix_sort.h"
#include "base/reused_vector.h"
#include "base/union_find.h"
#include "regionmesh/flat_array.h"

namespace regionmesh {
namespace {

TEST(ReusedVector, keeps_room_for_the_last_content_but_not_for_the_largest) {
    std::vector<std::uint64_t> array(1 << 20, 7);
    clear_reused(array);
    EXPECT_TRUE(array.empty());
    EXPECT_GE(array.capacity(), std::size_t{1} << 20);
    array.resize(20000, 7);
    clear_reused(array);
    EXPECT_TRUE(array.empty());
    EXPECT_EQ(array.capacity(), 40000u);
    array.resize(3);
    clear_reused(array);
    EXPECT_LE(array.capacity() * sizeof(array[0]), std::size_t{64} << 10);
    array.resize(5);
    clear_reused(array);
    EXPECT_GE(array.capacity() * sizeof(array[0]), std::size_t{64} << 10);
    resize_reused(array, 1 << 20);
    EXPECT_EQ(array.size(), std::size_t{1} << 20);
    resize_reused(array, 20000);
    EXPECT_EQ(array.size(), 20000u);
    EXPECT_EQ(array.capacity(), 40000u);
}

TEST(FlatArray, grows_and_keeps_what_it_holds) {
    FlatArray<std::uint64_t> array;
    EXPECT_TRUE(array.empty());
    for (std::uint32_t n = 0; n < 10000; ++n) array.push_back(mix64(n));
    ASSERT_EQ(array.size(), 10000u);
    for (std::uint32_t n = 0; n < 10000; ++n) EXPECT_EQ(array[n], mix64(n));
    array.resize(3);
    array.resize(5, 7);
    EXPECT_EQ(array[2], mix64(2));
    EXPECT_EQ(array[4], 7u);
    EXPECT_EQ(array.bytes(), 40u);
}

TEST(FlatArray, can_repeat_its_own_element_while_it_grows) {
    FlatArray<int> array;
    array.push_back(42);
    for (int n = 0; n < 5000; ++n) array.push_back(array[0]);
    array.resize(100'000, array[0]);
    EXPECT_TRUE(std::all_of(array.begin(), array.end(), [](int x) { return x == 42; }));
}

TEST(FlatArray, moves_leave_one_owner) {
    FlatArray<int> a;
    a.push_back(1);
    FlatArray<int> b(std::move(a));
    EXPECT_EQ(b.size(), 1u);
    FlatArray<int> c;
    c = std::move(b);
    EXPECT_EQ(c[0], 1);
}

TEST(UnionFind, joins_and_keeps_the_smaller_root) {
    UnionFind sets(6);
    sets.join(5, 3);
    sets.join(3, 4);
    sets.join(1, 0);
    EXPECT_EQ(sets.find(5), 3u);
    EXPECT_EQ(sets.find(4), 3u);
    EXPECT_EQ(sets.find(1), 0u);
    EXPECT_EQ(sets.find(2), 2u);
}

TEST(RadixSort, is_stable_over_all_32_bits) {
    std::vector<KeyedIndex> items;
    for (std::uint32_t n = 0; n < 5000; ++n) items.push_back({static_cast<std::uint32_t>(mix64(n % 1700)), n});
    std::vector<KeyedIndex> expected = items;
    std::ranges::stable_sort(expected, {}, &KeyedIndex::key);
    radix_sort(items);
    for (std::size_t n = 0; n < items.size(); ++n) ASSERT_EQ(items[n].index, expected[n].index);
}

TEST(HashUnit, is_in_0_to_1_and_the_same_both_ways) {
    double sum = 0;
    for (std::uint32_t n = 0; n < 1000; ++n) {
        const double x = hash_unit(n, n + 7);
        EXPECT_GE(x, 0);
        EXPECT_LT(x, 1);
        EXPECT_EQ(x, hash_unit(n + 7, n));
        sum += x;
    }
    EXPECT_NEAR(sum / 1000, 0.5, 0.05);
}

}  // namespace
}  // namespace regionmesh
