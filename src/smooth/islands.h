// Separate parts of the surface, and the test whether one has changed sides of another.
#pragma once

#include <array>
#include <vector>

#include "smooth/surface_window.h"

namespace regionmesh {

/// Joins vertices to parts as faces arrive. The root of a part is its newest vertex: a complete part has its root in
/// the last chunk that it reaches.
class Parts {
public:
    /// The faces of a chunk, in order of chunks.
    void add_chunk(const SurfaceWindow& window, std::uint32_t chunk);

    /// For each part that ends in this chunk, its first vertex there by position, which does not depend on numbers.
    /// Requires that the next chunk was added, if there is one.
    std::vector<std::uint32_t> that_end_in(const SurfaceWindow& window, std::uint32_t chunk);

    std::uint32_t root(std::uint32_t v);
    void drop_before(std::uint32_t v) { parent_.drop_before(v); }
    std::size_t bytes() const { return parent_.bytes(); }

private:
    SlidingArray<std::uint32_t> parent_;  // a newer vertex of the part, or itself
};

/// A face before and after it moved; positions are in the order of `vertices`.
struct MovedFace {
    std::array<std::uint32_t, 3> vertices;
    std::array<Vec3, 3> before, after;
};

/// May a point that moved from `before` to `after` have changed sides of the surface that this face belongs to? The way
/// of the point is a segment; the face sweeps three tetrahedra, split in the same way by both faces at an edge. The
/// point has not changed sides if, for all faces, the segment does not meet the face before it moved and the tetrahedra
/// do not contain the point after it moved. Exact; touching counts as meeting.
bool may_change_sides(Vec3 before, Vec3 after, const MovedFace& face);

}  // namespace regionmesh
