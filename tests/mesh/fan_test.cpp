#include "mesh/fan.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "support/random.h"

namespace regionmesh {
namespace {

/// "ab bc ca": pages by their ends.
std::vector<FanPage> fan_of(const std::string& text) {
    std::vector<FanPage> fan;
    for (std::uint32_t n = 0; n < text.size(); n += 3) fan.push_back({VertexId(text[n]), VertexId(text[n + 1]), n / 3});
    return fan;
}

std::string ordered(const std::string& text) {
    std::vector<FanPage> fan = fan_of(text);
    if (!order_fan(fan)) return "no";
    std::string result;
    for (const FanPage& page : fan)
        result += std::string(result.empty() ? "" : " ") + char(page.first) + char(page.second);
    return result;
}

TEST(OrderFan, goes_round_a_closed_fan) {
    EXPECT_EQ(ordered("ab ca bc"), "ab bc ca");
    EXPECT_EQ(ordered("ab da cd bc"), "ab bc cd da");
    EXPECT_EQ(ordered("ab ba"), "ab ba");
}

TEST(OrderFan, finds_the_beginning_of_an_open_fan) {
    EXPECT_EQ(ordered("bc ab"), "ab bc");
    EXPECT_EQ(ordered("cd ab ef bc de"), "ab bc cd de ef");
    EXPECT_EQ(ordered("ab"), "ab");
}

TEST(OrderFan, says_no_to_all_else) {
    EXPECT_EQ(ordered("ab cd"), "no") << "two fans";
    EXPECT_EQ(ordered("ab bc ca de ef fd"), "no") << "two closed ones";
    EXPECT_EQ(ordered("ab bc ca xy"), "no");
    EXPECT_EQ(ordered("ab bc ca ad de ea"), "no") << "twice through a";
    EXPECT_EQ(ordered("xa ab bc ca ax"), "no");
    EXPECT_EQ(ordered("ab ab"), "no") << "twice the same";
    EXPECT_EQ(ordered("ab bc bd"), "no") << "a fork";
    EXPECT_EQ(ordered("ab cb"), "no") << "one the wrong way";
}

TEST(OrderFan, takes_pages_in_any_order) {
    test::Random random(1);
    for (int n = 0; n < 200; ++n) {
        const std::uint32_t count = 3 + random.below(10);
        const bool closed = random.below(2) == 0;
        std::vector<FanPage> fan;
        for (std::uint32_t k = 0; k < count; ++k)
            fan.push_back({VertexId{k}, VertexId{closed ? (k + 1) % count : k + 1}, k});
        for (std::uint32_t k = 1; k < count; ++k) std::swap(fan[k], fan[random.below(k + 1)]);
        ASSERT_TRUE(order_fan(fan));
        EXPECT_EQ(is_closed(fan), closed);
        for (std::uint32_t k = 1; k < count; ++k) EXPECT_EQ(fan[k].first, fan[k - 1].second);
        if (!closed) {
            EXPECT_EQ(fan[0].first, VertexId{0});
        }
    }
}

}  // namespace
}  // namespace regionmesh
