#include "formats/surface/msh_layout.h"

#include <gtest/gtest.h>

#include <initializer_list>

namespace regionmesh::formats {
namespace {

MshTags tags_of(std::initializer_list<std::uint64_t> list) {
    MshTags tags;
    for (const std::uint64_t tag : list) tags.add(tag);
    return tags;
}

TEST(MshTags, finds_each_tag_in_any_order) {
    for (const auto& list :
         {std::initializer_list<std::uint64_t>{}, {7}, {3, 4, 5}, {3, 4, 9, 12}, {0, 8, 2, UINT64_MAX, 1}}) {
        MshTags tags = tags_of(list);
        EXPECT_EQ(tags.finish(), std::nullopt);
        EXPECT_EQ(tags.size(), list.size());
        std::uint32_t index = 0;
        for (const std::uint64_t tag : list) {
            EXPECT_EQ(tags.find(tag), index);
            EXPECT_EQ(tags[index++], tag);
        }
        for (const std::uint64_t other : {std::uint64_t{6}, std::uint64_t{13}})
            EXPECT_EQ(tags.find(other), std::nullopt);
    }
}

TEST(MshTags, names_a_tag_that_was_added_twice) {
    EXPECT_EQ(tags_of({4, 5, 5}).finish(), 5u);
    EXPECT_EQ(tags_of({9, 4, 7, 9}).finish(), 9u);
}

}  // namespace
}  // namespace regionmesh::formats
