// Disjoint sets over 0 .. n-1.
#pragma once

#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <new>
#include <utility>

#include "regionmesh/huge_pages.h"

namespace regionmesh {

/// Several threads may find and join concurrently (Anderson and Woll 1991): a number is only ever linked to a smaller
/// one of its set. In the end the root of each set is its smallest number, so the result does not depend on the order
/// of joins.
class UnionFind {
public:
    explicit UnionFind(std::uint32_t size)
        : steps_(static_cast<std::uint32_t*>(std::calloc(std::size_t{size} + 1, sizeof(std::uint32_t)))) {
        if (!steps_) throw std::bad_alloc();
        prefer_huge_pages(steps_.get(), (std::size_t{size} + 1) * sizeof(std::uint32_t));
    }

    std::uint32_t find(std::uint32_t x) {
        for (;;) {
            const std::uint32_t up = parent(x);
            if (up == x) return x;
            const std::uint32_t top = parent(up);
            if (top == up) return up;
            step(x).store(x - top, std::memory_order_relaxed);  // any value that another thread writes is above x
            x = top;
        }
    }
    bool is_root(std::uint32_t x) const { return parent(x) == x; }

    void join(std::uint32_t a, std::uint32_t b) {
        for (;;) {
            a = find(a), b = find(b);
            if (a == b) return;
            if (a > b) std::swap(a, b);
            std::uint32_t root = 0;
            if (step(b).compare_exchange_strong(root, b - a, std::memory_order_relaxed)) return;
        }
    }

private:
    struct Free {
        void operator()(std::uint32_t* memory) const { std::free(memory); }
    };

    std::atomic_ref<std::uint32_t> step(std::uint32_t x) const { return std::atomic_ref(steps_[x]); }
    std::uint32_t parent(std::uint32_t x) const { return x - step(x).load(std::memory_order_relaxed); }

    // Distance down to the parent: 0 at a root. Zero-filled memory is not touched before it is used.
    std::unique_ptr<std::uint32_t[], Free> steps_;
};

}  // namespace regionmesh
