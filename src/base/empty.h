// Empties an array that is filled again and again.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace regionmesh {

/// Keeps room for twice what the array held, or 64 KiB: what one large filling took does not stay for good.
template <class T>
void empty(std::vector<T>& items) {
    constexpr std::size_t kAlways = (std::size_t{64} << 10) / sizeof(T);
    const std::size_t room = std::max(2 * items.size(), kAlways);
    items.clear();
    if (items.capacity() <= 2 * room) return;
    items.shrink_to_fit();
    items.reserve(room);
}

}  // namespace regionmesh
