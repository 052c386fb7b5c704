// Which vertices a vertex is smoothed by (P 4.2).
#pragma once

#include <cstdint>
#include <span>

#include "base/sliding_lists.h"
#include "smooth/chunk_stars.h"

namespace regionmesh {

/// Neighbours of v are the w joined to it by an edge with all the labels of v: their label sets hold that of v. Inside
/// an interface these are all neighbours, on a line the two along it. A point where lines end has none and stays,
/// unless `move_points`: then it has the ends of its lines. Where the surface ends outside the sides of the box,
/// vertices have none. Neighbours come in the order of their places, so that sums over them do not depend on numbers.
class Neighbours {
public:
    explicit Neighbours(bool move_points) : move_points_(move_points) {}

    /// Appends the neighbours of a chunk's vertices. Layers come in order.
    void add_chunk(const SurfaceWindow& window, const ChunkStars& stars, std::uint32_t threads);

    std::span<const std::uint32_t> of(std::uint32_t v) const { return lists_.of(v); }
    void drop_before(std::uint32_t v) { lists_.drop_before(v); }
    std::size_t bytes() const { return lists_.bytes(); }

private:
    SlidingLists lists_;
    bool move_points_;
};

}  // namespace regionmesh
