// Vectors that are filled again and again.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace regionmesh {

/// Releases the memory that an unusually large content took: keeps a capacity of at most four times `size` elements, or
/// 128 KiB. Clears the vector where it releases memory.
template <class T>
void limit_capacity(std::vector<T>& items, std::size_t size) {
    constexpr std::size_t kSmall = (std::size_t{64} << 10) / sizeof(T);
    const std::size_t kept = std::max(2 * size, kSmall);
    if (items.capacity() <= 2 * kept) return;
    items.clear();
    items.shrink_to_fit();
    items.reserve(kept);
}

/// Clears a vector. Its capacity stays, unless the last content was much smaller.
template <class T>
void clear_reused(std::vector<T>& items) {
    const std::size_t size = items.size();
    items.clear();
    limit_capacity(items, size);
}

/// Resizes a vector whose elements will all be overwritten.
template <class T>
void resize_reused(std::vector<T>& items, std::size_t size) {
    limit_capacity(items, size);
    items.resize(size);
}

}  // namespace regionmesh
