// Separate parts of the surface, and whether one has changed sides of another.
#pragma once

#include <array>
#include <vector>

#include "smooth/surface_window.h"

namespace regionmesh {

/// Joins vertices to parts as faces come in. The root of a part is its newest vertex, so that a part that is complete
/// has its root in the last chunk that it reaches.
class Parts {
public:
    /// The faces of a chunk, in order of chunks.
    void add_chunk(const SurfaceWindow& window, std::uint32_t chunk);

    /// Of each part that ends in this chunk, its first vertex there by place, whatever the numbers. Requires that the
    /// next chunk was added, if there is one.
    std::vector<std::uint32_t> that_end_in(const SurfaceWindow& window, std::uint32_t chunk);

    std::uint32_t root(std::uint32_t v);
    void drop_before(std::uint32_t v) { parent_.drop_before(v); }
    std::size_t bytes() const { return parent_.bytes(); }

private:
    SlidingArray<std::uint32_t> parent_;  // a newer vertex of the part, or itself
};

/// A face before and after it moved; the places go with the vertices' numbers.
struct MovedFace {
    std::array<std::uint32_t, 3> vertices;
    std::array<Vec3, 3> before, after;
};

/// May a point that went from `before` to `after` have changed sides of a surface by this face of it? The point's way
/// is a segment; the face sweeps three tetrahedra, split alike from both sides of an edge. If neither the segment meets
/// the face as it was nor the tetrahedra hold the point as it is, for any face, then it has not. Exact; touching is
/// taken for meeting.
bool may_change_sides(Vec3 before, Vec3 after, const MovedFace& face);

}  // namespace regionmesh
