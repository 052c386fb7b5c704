// The neighbours that a vertex is smoothed with (P 4.2).
#pragma once

#include <cstdint>
#include <span>

#include "base/sliding_lists.h"
#include "smooth/chunk_stars.h"

namespace regionmesh {

/// Neighbours of v are the vertices joined to it by an edge that has all the labels of v. Inside an interface these are
/// all adjacent vertices, on a triple line the two along it. A quadruple point has none and stays, unless
/// `move_points`: then it has the next vertices of its lines. Vertices where the surface ends inside the box have none.
/// Neighbours are sorted by position, so that sums over them do not depend on vertex numbers.
class Neighbours {
public:
    explicit Neighbours(bool move_points) : move_points_(move_points) {}

    /// Appends the neighbours of the vertices of a chunk. Chunks come in order.
    void add_chunk(const SurfaceWindow& window, const ChunkStars& stars, std::uint32_t threads);

    std::span<const std::uint32_t> of(std::uint32_t v) const { return lists_.of(v); }
    void drop_before(std::uint32_t v) { lists_.drop_before(v); }
    std::size_t bytes() const { return lists_.bytes(); }

private:
    SlidingLists lists_;
    bool move_points_;
};

}  // namespace regionmesh
