// The faces of one region at a vertex, in their order around it.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>

#include "regionmesh/ids.h"

namespace regionmesh {

/// A face at a vertex, seen from one region: it leads from one neighbour of the vertex to the next.
struct FanPage {
    VertexId first, second;
    std::uint32_t name;  // name of the page, in the caller's numbering
};

inline bool is_closed(std::span<const FanPage> fan) { return fan.back().second == fan.front().first; }

/// Extends an open fan at its front: its first n pages are in order and cannot be continued, so it begins with a page
/// that ends where the first one begins.
inline bool extend_back(std::span<FanPage> fan, std::size_t n) {
    for (std::size_t m = n; m < fan.size(); ++m) {
        if (fan[m].second != fan[0].first) continue;
        std::swap(fan[n], fan[m]);
        std::rotate(fan.data(), fan.data() + n, fan.data() + n + 1);
        return true;
    }
    return false;
}

/// Orders the pages so that each begins where the previous one ends. Returns false if some pages cannot be reached. A
/// closed fan passes each neighbour once.
inline bool order_fan(std::span<FanPage> fan) {
    for (std::size_t n = 1; n < fan.size(); ++n) {
        if (is_closed(fan.first(n))) return false;
        // No branches: they would be mispredicted.
        const VertexId here = fan[n - 1].second;
        std::size_t next = 0, fits = 0;
        for (std::size_t m = n; m < fan.size(); ++m) {
            const bool fit = fan[m].first == here;
            next = fit ? m : next;
            fits += fit;
        }
        if (fits > 1) return false;
        if (fits == 1)
            std::swap(fan[n], fan[next]);
        else if (!extend_back(fan, n))
            return false;
    }
    return true;
}

}  // namespace regionmesh
