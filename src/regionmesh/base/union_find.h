// Disjoint sets over 0 .. n-1.
#pragma once

#include <atomic>
#include <cstdint>
#include <utility>
#include <vector>

namespace regionmesh {

/// Several threads may find and join at once (Anderson and Woll 1991): a number is only ever hung below a smaller one
/// of its set. The smallest of each set is its root in the end, so that the result does not depend on the order of
/// joins.
class UnionFind {
public:
    explicit UnionFind(std::uint32_t size) : parent_(size) {
        for (std::uint32_t x = 0; x < size; ++x) parent_[x].store(x, std::memory_order_relaxed);
    }

    std::uint32_t find(std::uint32_t x) {
        for (;;) {
            const std::uint32_t up = parent(x);
            if (up == x) return x;
            const std::uint32_t top = parent(up);
            if (top == up) return up;
            parent_[x].store(top, std::memory_order_relaxed);  // whatever others write, it is above x
            x = top;
        }
    }
    bool is_root(std::uint32_t x) const { return parent(x) == x; }

    void join(std::uint32_t a, std::uint32_t b) {
        for (;;) {
            a = find(a), b = find(b);
            if (a == b) return;
            if (a > b) std::swap(a, b);
            std::uint32_t root = b;
            if (parent_[b].compare_exchange_strong(root, a, std::memory_order_relaxed)) return;
        }
    }

private:
    std::uint32_t parent(std::uint32_t x) const { return parent_[x].load(std::memory_order_relaxed); }

    std::vector<std::atomic<std::uint32_t>> parent_;
};

}  // namespace regionmesh
