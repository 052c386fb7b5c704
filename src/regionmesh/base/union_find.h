// Disjoint sets over 0 .. n-1.
#pragma once

#include <cstdint>
#include <numeric>
#include <vector>

namespace regionmesh {

class UnionFind {
public:
    explicit UnionFind(std::uint32_t size) : parent_(size) { std::iota(parent_.begin(), parent_.end(), 0u); }

    std::uint32_t find(std::uint32_t x) {
        while (parent_[x] != x) x = parent_[x] = parent_[parent_[x]];
        return x;
    }
    /// The smaller root stays, so that the result does not depend on the order of unions.
    void join(std::uint32_t a, std::uint32_t b) {
        a = find(a), b = find(b);
        if (a < b)
            parent_[b] = a;
        else
            parent_[a] = b;
    }

private:
    std::vector<std::uint32_t> parent_;
};

}  // namespace regionmesh
