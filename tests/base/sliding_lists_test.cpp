#include "base/sliding_lists.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <deque>
#include <vector>

#include "base/hash.h"

namespace regionmesh {
namespace {

using testing::ElementsAre;
using List = std::vector<std::uint32_t>;

TEST(SlidingLists, lists_keep_their_numbers) {
    SlidingLists lists;
    lists.push_back(List{1, 2});
    lists.push_back(List{});
    lists.push_back(List{3});
    lists.push_back(List{4, 5, 6});
    EXPECT_EQ(lists.end(), 4u);
    EXPECT_THAT(lists.of(0), ElementsAre(1, 2));
    EXPECT_TRUE(lists.of(1).empty());
    lists.drop_before(2);
    EXPECT_EQ(lists.end(), 4u);
    EXPECT_THAT(lists.of(2), ElementsAre(3));
    EXPECT_THAT(lists.of(3), ElementsAre(4, 5, 6));
    lists.push_back(List{7});
    EXPECT_THAT(lists.of(4), ElementsAre(7));
}

TEST(SlidingLists, may_be_let_go_whole_and_go_on) {
    SlidingLists lists;
    lists.push_back(List{1, 2});
    lists.drop_before(1);
    EXPECT_EQ(lists.end(), 1u);
    lists.push_back(List{});
    lists.push_back(List{8, 9});
    EXPECT_TRUE(lists.of(1).empty());
    EXPECT_THAT(lists.of(2), ElementsAre(8, 9));
}

TEST(SlidingLists, a_list_of_a_list_before_may_be_added) {
    SlidingLists lists;
    lists.push_back(List(600, 7));
    for (std::uint32_t n = 0; n < 20; ++n) {
        const List copy(lists.of(n).begin(), lists.of(n).end());
        lists.push_back(copy);
    }
    EXPECT_EQ(lists.of(20).size(), 600u);
    EXPECT_EQ(lists.of(20).back(), 7u);
}

TEST(SlidingLists, do_what_a_deque_of_lists_does) {
    for (std::uint64_t seed : {1, 2, 3}) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        SlidingLists lists;
        std::deque<List> mesh;
        std::uint32_t first = 0;
        std::uint64_t state = mix64(seed);
        for (int step = 0; step < 1000; ++step) {
            state = mix64(state);
            if (state % 4 != 0) {
                List list((state >> 8) % 6);
                for (std::uint32_t& item : list) item = static_cast<std::uint32_t>(state = mix64(state));
                lists.push_back(list);
                mesh.push_back(list);
            } else {
                const std::uint32_t count =
                    std::min<std::uint32_t>((state >> 8) % 8, static_cast<std::uint32_t>(mesh.size()));
                first += count;
                mesh.erase(mesh.begin(), mesh.begin() + count);
                lists.drop_before(first);
            }
            ASSERT_EQ(lists.end(), first + mesh.size());
            for (std::uint32_t n = 0; n < mesh.size(); ++n)
                ASSERT_THAT(lists.of(first + n), testing::ElementsAreArray(mesh[n]));
        }
    }
}

}  // namespace
}  // namespace regionmesh
