// Sorts many pairs by a 32-bit key, stably, in a time that does not depend on their order.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace regionmesh {

struct KeyedIndex {
    std::uint32_t key;
    std::uint32_t index;
};

/// Least significant digit first, three passes of 11 bits; needs as much room again while it runs.
inline void radix_sort(std::vector<KeyedIndex>& items) {
    constexpr int kBits = 11;
    std::vector<KeyedIndex> other(items.size());
    for (int shift = 0; shift < 32; shift += kBits) {
        std::array<std::uint32_t, (1u << kBits) + 1> start{};
        for (const KeyedIndex& item : items) ++start[(item.key >> shift & ((1u << kBits) - 1)) + 1];
        for (std::uint32_t d = 1; d < start.size(); ++d) start[d] += start[d - 1];
        for (const KeyedIndex& item : items) other[start[item.key >> shift & ((1u << kBits) - 1)]++] = item;
        items.swap(other);
    }
}

}  // namespace regionmesh
