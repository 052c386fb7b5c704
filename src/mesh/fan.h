// The faces of one region at a vertex, in the order in which they go round it.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>

#include "regionmesh/ids.h"

namespace regionmesh {

/// A face seen from a vertex and by a region: it leads from one neighbour to the next.
struct FanPage {
    VertexId first, second;
    std::uint32_t name;  // whose page it is, in the caller's numbers
};

inline bool is_closed(std::span<const FanPage> fan) { return fan.back().second == fan.front().first; }

/// An open fan whose first n pages are in order, and do not go on, begins earlier: with a page that ends where it
/// begins now.
inline bool extend_back(std::span<FanPage> fan, std::size_t n) {
    for (std::size_t m = n; m < fan.size(); ++m) {
        if (fan[m].second != fan[0].first) continue;
        std::swap(fan[n], fan[m]);
        std::rotate(fan.data(), fan.data() + n, fan.data() + n + 1);
        return true;
    }
    return false;
}

/// Brings the pages in order, each beginning where the one before ends. False where some are left that cannot be
/// reached. A closed fan in order passes each neighbour once.
inline bool order_fan(std::span<FanPage> fan) {
    for (std::size_t n = 1; n < fan.size(); ++n) {
        if (is_closed(fan.first(n))) return false;
        // No jumps: there is no telling which one fits.
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
