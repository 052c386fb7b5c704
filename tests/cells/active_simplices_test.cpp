#include "cells/active_simplices.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "support/random.h"

namespace regionmesh {
namespace {

using Simplices = ActiveSimplices<std::uint64_t>;

/// A node, an edge or a triangle near a rank.
SimplexKey random_key(test::Random& random, std::uint32_t lowest, std::uint32_t reach) {
    SimplexKey key{lowest + random.below(reach), kNoRank, kNoRank};
    const std::uint32_t size = random.below(3);
    if (size > 0) key[1] = key[0] + 1 + random.below(reach);
    if (size > 1) key[2] = key[1] + 1 + random.below(reach);
    return key;
}

std::set<SimplexKey> keys_of_lowest(Simplices& simplices, std::uint32_t rank) {
    std::set<SimplexKey> keys;
    simplices.for_lowest(rank, [&](std::uint32_t place) { EXPECT_TRUE(keys.insert(simplices[place].corners).second); });
    return keys;
}

TEST(ActiveSimplices, notes_are_found_as_in_a_map_while_the_sweep_moves) {
    for (std::uint32_t reach : {2u, 7u, 40u}) {
        test::Random random(reach);
        Simplices simplices;
        std::map<SimplexKey, std::uint64_t> map;
        for (std::uint32_t rank = 0; rank < 400; ++rank) {
            for (int n = 0; n < 60; ++n) {
                const SimplexKey key = random_key(random, rank, reach);
                bool is_new = false;
                const std::uint32_t place = simplices.find_or_add(key, &is_new);
                const auto [at, was_new] = map.try_emplace(key, 0);
                ASSERT_EQ(is_new, was_new);
                ASSERT_EQ(simplices[place].corners, key);
                ASSERT_EQ(simplices[place].note, at->second) << "a new note is like new, also where one was before";
                simplices[place].note = at->second = random.below(1u << 30);
            }
            std::set<SimplexKey> expected;
            for (auto at = map.begin(); at != map.end() && at->first[0] == rank; at = map.erase(at))
                expected.insert(at->first);
            ASSERT_EQ(keys_of_lowest(simplices, rank), expected);
            simplices.drop(rank);
        }
        for (const auto& [key, note] : map) {
            bool is_new = true;
            ASSERT_EQ(simplices[simplices.find_or_add(key, &is_new)].note, note);
            ASSERT_FALSE(is_new);
        }
    }
}

TEST(ActiveSimplices, many_keys_that_differ_in_one_corner_only_are_kept_apart) {
    for (int corner = 0; corner < 3; ++corner) {
        Simplices simplices;
        const auto key = [&](std::uint32_t n) {
            SimplexKey made{1, 1u << 16, 1u << 30};
            made[corner] += n;
            return made;
        };
        for (std::uint32_t n = 0; n < 5000; ++n) simplices[simplices.find_or_add(key(n))].note = n;
        for (std::uint32_t n = 0; n < 5000; ++n) ASSERT_EQ(simplices[simplices.find_or_add(key(n))].note, n);
    }
}

TEST(ActiveSimplices, what_was_let_go_of_makes_room) {
    Simplices simplices;
    std::size_t bytes = 0;
    for (std::uint32_t rank = 0; rank < 3000; ++rank) {
        for (std::uint32_t n = 1; n < 40; ++n) simplices.find_or_add({rank, rank + n, kNoRank});
        simplices.drop(rank);
        if (rank == 100) bytes = simplices.bytes();
    }
    EXPECT_LE(simplices.bytes(), 2 * bytes);
}

TEST(ActiveSimplices, ranks_may_be_let_go_of_that_have_nothing) {
    Simplices simplices;
    for (std::uint32_t rank = 0; rank < 10; ++rank) simplices.drop(rank);
    simplices[simplices.find_or_add({12, kNoRank, kNoRank})].note = 5;
    EXPECT_TRUE(keys_of_lowest(simplices, 11).empty());
    EXPECT_TRUE(keys_of_lowest(simplices, 99).empty());
    simplices.drop(10);
    simplices.drop(11);
    EXPECT_EQ(simplices[simplices.find_or_add({12, kNoRank, kNoRank})].note, 5u);
}

TEST(ActiveSimplices, a_visit_may_add_others) {
    Simplices simplices;
    for (std::uint32_t n = 1; n < 100; ++n) simplices.find_or_add({0, n, kNoRank});
    int visits = 0;
    simplices.for_lowest(0, [&](std::uint32_t place) {
        const std::uint32_t other = simplices[place].corners[1];
        for (std::uint32_t n = 1; n < 100; ++n) simplices.find_or_add({other, other + n, kNoRank});
        ++visits;
    });
    EXPECT_EQ(visits, 99);
    EXPECT_EQ(keys_of_lowest(simplices, 50).size(), 99u);
}

}  // namespace
}  // namespace regionmesh
