// Stable sort of many pairs by a 32-bit key; its time does not depend on their order.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "base/parallel_for.h"

namespace regionmesh {

struct KeyedIndex {
    std::uint32_t key;
    std::uint32_t index;
};

/// Least significant digit first, up to three passes of 11 bits, as many as the largest key needs; needs memory for a
/// second copy. Each pass counts the digits in each chunk of items, which gives the start where each chunk writes its
/// items of each digit.
inline void radix_sort(std::vector<KeyedIndex>& items, std::uint32_t threads = 1) {
    constexpr int kBits = 11;
    constexpr std::uint32_t kDigits = 1u << kBits, kChunk = 1u << 16;
    const auto size = static_cast<std::uint32_t>(items.size());
    const std::uint32_t chunks = size / kChunk + 1;
    std::vector<KeyedIndex> other(size);
    std::vector<std::array<std::uint32_t, kDigits>> starts(chunks);
    std::uint32_t all_bits = 0;
    for (const KeyedIndex& item : items) all_bits |= item.key;
    for (int shift = 0; shift < 32 && all_bits >> shift != 0; shift += kBits) {
        const auto for_chunk = [&](std::uint32_t chunk, auto&& visit) {
            std::uint32_t* const start = starts[chunk].data();
            const KeyedIndex* const end = items.data() + std::min(items.size(), (chunk + std::size_t{1}) * kChunk);
            for (const KeyedIndex* item = items.data() + std::size_t{chunk} * kChunk; item != end; ++item)
                visit(*item, start[item->key >> shift & (kDigits - 1)]);
        };
        parallel_for(chunks, threads, [&](std::uint32_t chunk) {
            starts[chunk].fill(0);
            for_chunk(chunk, [](const KeyedIndex&, std::uint32_t& count) { ++count; });
        });
        std::uint32_t next = 0;
        for (std::uint32_t digit = 0; digit < kDigits; ++digit)
            for (auto& start : starts) next += std::exchange(start[digit], next);
        parallel_for(chunks, threads, [&](std::uint32_t chunk) {
            for_chunk(chunk, [to = other.data()](const KeyedIndex& item, std::uint32_t& start) { to[start++] = item; });
        });
        items.swap(other);
    }
}

}  // namespace regionmesh
