#include "simplify/rank/edge_heap.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "base/hash.h"

namespace regionmesh {
namespace {

/// What the heap promises, slowly: keys in order, equal ones by vertex.
class SlowHeap {
public:
    void set(std::uint32_t v, float key) {
        remove(v);
        keys_[v] = key;
        order_.insert({key, v});
    }
    void remove(std::uint32_t v) {
        if (!keys_.contains(v)) return;
        const auto [first, last] = order_.equal_range(keys_.at(v));
        for (auto at = first; at != last; ++at) {
            if (at->second != v) continue;
            order_.erase(at);
            break;
        }
        keys_.erase(v);
    }
    bool contains(std::uint32_t v) const { return keys_.contains(v); }
    std::size_t size() const { return order_.size(); }
    std::pair<float, std::uint32_t> top() const {
        std::uint32_t least = ~0u;
        const auto [first, last] = order_.equal_range(order_.begin()->first);
        for (auto at = first; at != last; ++at) least = std::min(least, at->second);
        return {first->first, least};
    }

private:
    std::multimap<float, std::uint32_t> order_;
    std::map<std::uint32_t, float> keys_;
};

TEST(EdgeHeap, is_a_sorted_map_under_random_changes) {
    constexpr std::uint32_t kVertices = 300;
    for (std::uint64_t seed : {1, 2, 3}) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        EdgeHeap heap(kVertices);
        SlowHeap slow;
        std::uint64_t state = seed;
        const auto below = [&](std::uint32_t end) { return static_cast<std::uint32_t>((state = mix64(state)) % end); };
        for (int n = 0; n < 20000; ++n) {
            const std::uint32_t v = below(kVertices);
            if (below(3) == 0) {
                heap.remove(VertexId{v});
                slow.remove(v);
            } else {
                const float key = static_cast<float>(below(50));  // many ties
                heap.set(VertexId{v}, key);
                slow.set(v, key);
            }
            ASSERT_EQ(heap.size(), slow.size());
            ASSERT_EQ(heap.contains(VertexId{v}), slow.contains(v));
            if (heap.empty()) continue;
            ASSERT_EQ(heap.top_key(), slow.top().first);
            ASSERT_EQ(index(heap.top()), slow.top().second);
        }
    }
}

TEST(EdgeHeap, gives_all_back_in_order) {
    EdgeHeap heap(1000);
    for (std::uint32_t v = 0; v < 1000; ++v) heap.set(VertexId{v}, static_cast<float>(mix64(v) % 100));
    std::pair<float, std::uint32_t> last{-1, 0};
    while (!heap.empty()) {
        const std::pair<float, std::uint32_t> top{heap.top_key(), index(heap.top())};
        EXPECT_LT(last, top);
        EXPECT_EQ(heap.key(heap.top()), top.first);
        last = top;
        heap.remove(heap.top());
    }
}

TEST(EdgeHeap, order_does_not_depend_on_how_it_came_there) {
    EdgeHeap up(100), down(100);
    for (std::uint32_t v = 0; v < 100; ++v) up.set(VertexId{v}, static_cast<float>(v % 7));
    for (std::uint32_t v = 100; v-- > 0;) down.set(VertexId{v}, 50);
    for (std::uint32_t v = 0; v < 100; ++v) down.set(VertexId{v}, static_cast<float>(v % 7));
    while (!up.empty()) {
        ASSERT_EQ(up.top(), down.top());
        up.remove(up.top());
        down.remove(down.top());
    }
}

}  // namespace
}  // namespace regionmesh
