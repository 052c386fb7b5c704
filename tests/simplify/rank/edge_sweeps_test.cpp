#include "simplify/rank/edge_sweeps.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <vector>

#include "base/hash.h"
#include "judge/tuning.h"
#include "simplify/tuning.h"

namespace regionmesh {
namespace {

using testing::ElementsAre;

/// Takes `count` vertices out, those of next() in turn, each time with this argument of find_next().
std::vector<std::uint32_t> take(EdgeSweeps& edges, std::uint32_t count, std::uint64_t wanted) {
    std::vector<std::uint32_t> taken;
    while (taken.size() < count) {
        edges.find_next(wanted);
        for (VertexId v : edges.next()) {
            if (taken.size() == count) break;
            EXPECT_LE(edges.key(v), edges.limit());
            taken.push_back(index(v));
            edges.remove(v);
        }
    }
    return taken;
}

/// Keys 0, 1, 2 ... in mixed order.
std::vector<float> mixed_keys(std::uint32_t count) {
    std::vector<float> keys(count);
    std::vector<std::uint32_t> order(count);
    std::iota(order.begin(), order.end(), 0u);
    std::ranges::sort(order, {}, [](std::uint32_t v) { return mix64(v); });
    for (std::uint32_t n = 0; n < count; ++n) keys[order[n]] = static_cast<float>(n);
    return keys;
}

TEST(EdgeSweeps, sweep_visits_the_cheapest_wanted_in_stripes_side_by_side) {
    constexpr std::uint32_t kVertices = 4000;
    const std::vector<float> keys = mixed_keys(kVertices);
    for (const std::uint32_t wanted : {kLeastOfStripe, 3 * kLeastOfStripe, 100u, 400u}) {
        EdgeSweeps edges(kVertices);
        for (std::uint32_t v = 0; v < kVertices; ++v) edges.set(VertexId{v}, keys[v]);
        std::vector<std::uint32_t> cheapest;
        for (std::uint32_t v = 0; v < kVertices; ++v)
            if (keys[v] < wanted) cheapest.push_back(v);
        const std::uint32_t stripes = std::min(wanted / kLeastOfStripe, kMostStripes);
        edges.find_next(wanted);
        ASSERT_EQ(edges.next().size(), stripes);
        for (std::uint32_t n = 0; n < stripes; ++n)
            EXPECT_EQ(index(edges.next()[n]), cheapest[(n * wanted + stripes - 1) / stripes]);

        std::vector<std::uint32_t> taken = take(edges, wanted, wanted);
        for (std::uint32_t n = stripes; n < wanted - stripes; ++n) EXPECT_LT(taken[n - stripes], taken[n]);
        std::ranges::sort(taken);
        EXPECT_EQ(taken, cheapest);
    }
}

TEST(EdgeSweeps, a_sweep_is_limited_to_a_share_of_the_vertices_and_has_a_least_one) {
    constexpr std::uint32_t kVertices = 8192;
    const std::vector<float> keys = mixed_keys(kVertices);
    for (const auto& [wanted, visited] :
         {std::pair{1u, kVertices / kLeastSweepPart + 1}, std::pair{kVertices, kVertices / kMostSweepPart + 1}}) {
        EdgeSweeps edges(kVertices);
        for (std::uint32_t v = 0; v < kVertices; ++v) edges.set(VertexId{v}, keys[v]);
        for (std::uint32_t v : take(edges, visited, wanted)) EXPECT_LT(keys[v], visited);
    }
}

TEST(EdgeSweeps, cheaper_vertices_come_in_this_sweep_if_they_lie_ahead_in_their_stripe_and_else_in_the_next) {
    EdgeSweeps edges(50);
    for (std::uint32_t v = 0; v < 50; ++v) edges.set(VertexId{v}, 100 + static_cast<float>(v));
    for (std::uint32_t v : {10, 20, 30}) edges.set(VertexId{v}, 1);
    EXPECT_THAT(take(edges, 1, 3), ElementsAre(10));
    edges.set(VertexId{5}, 0.5f);
    edges.set(VertexId{25}, 0.5f);
    EXPECT_THAT(take(edges, 4, 1), ElementsAre(20, 25, 30, 5));
}

TEST(EdgeSweeps, dearer_vertices_are_left_to_a_later_sweep) {
    EdgeSweeps edges(50);
    for (std::uint32_t v = 0; v < 50; ++v) edges.set(VertexId{v}, static_cast<float>(v));
    edges.find_next(3);
    EXPECT_THAT(edges.next(), ElementsAre(VertexId{0}));
    edges.set(VertexId{0}, 1000);
    EXPECT_THAT(take(edges, 2, 3), ElementsAre(1, 2));
    EXPECT_EQ(edges.key(VertexId{0}), 1000);
    EXPECT_EQ(take(edges, 48, 3).back(), 0);
    EXPECT_TRUE(edges.empty());
}

TEST(EdgeSweeps, all_come_in_order_of_limits_with_equal_and_negative_keys) {
    constexpr std::uint32_t kVertices = 3000;
    EdgeSweeps edges(kVertices);
    std::vector<float> keys(kVertices);
    for (std::uint32_t v = 0; v < kVertices; ++v) {
        keys[v] = 1e-30f * static_cast<float>(static_cast<int>(mix64(v) % 7) - 3);
        edges.set(VertexId{v}, keys[v]);
        edges.set(VertexId{v}, keys[v]);
    }
    std::vector<std::uint32_t> taken = take(edges, kVertices, 1);
    for (std::uint32_t n = 1; n < kVertices; ++n) ASSERT_LE(keys[taken[n - 1]], keys[taken[n]]);
    std::ranges::sort(taken);
    for (std::uint32_t n = 0; n < kVertices; ++n) ASSERT_EQ(taken[n], n);
    EXPECT_TRUE(edges.empty());
    edges.remove(VertexId{0});  // once more
    EXPECT_TRUE(edges.empty());
    EXPECT_FALSE(edges.contains(VertexId{0}));
}

}  // namespace
}  // namespace regionmesh
