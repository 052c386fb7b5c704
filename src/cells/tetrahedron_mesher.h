// Tetrahedra in, faces out: in the order of the sweep, holding what those to come may share (P 3.9).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "cells/label_pairs.h"
#include "cells/marching_tetrahedra.h"
#include "cells/open_simplices.h"
#include "cells/ranked_tetrahedra.h"
#include "cells/strip_mesher.h"
#include "mesh/chunk.h"
#include "regionmesh/label_oracle.h"

namespace regionmesh {

/// A vertex whose faces have all been made by now.
struct VertexEnd {
    std::uint32_t vertex, last_strip;  // the strip of the last of its faces
    bool is_on_hull;
    bool is_shared;          // by strips
    bool is_pinned = false;  // must stay as it is

    friend bool operator<(const VertexEnd& a, const VertexEnd& b) { return a.vertex < b.vertex; }
};

/// What the tetrahedra of a strip make. Vertices are numbered through, from `first_vertex`.
struct MeshedStrip {
    std::uint32_t first_vertex = 0;
    std::vector<ChunkVertex> vertices;  // sides of the box where all corners lie on them
    std::vector<ChunkFace> faces;       // behind those on the hull, exterior of the side of the box, or kHull
};

/// Labels at the points: the five cases of Nielson and Franke, with vertices at centroids of edges, triangles and
/// tetrahedra, known by their sorted corners; faces on the hull are cut by the labels of their corners. Labels of the
/// tetrahedra: the triangles between two of them, and those on the hull. On the way it counts what the labels say of
/// the model (DESIGN 4): with labels at the points the Euler characteristic of a region's boundary is
/// 2 (N0 - N1 + N2 - N3) over the simplices all of whose corners have the label; else N0 - N1 + N2 over those that a
/// tetrahedron of the label shares with another label or the exterior.
class TetrahedronMesher {
public:
    /// Holds references to the points, and to the reader for the names of its points.
    TetrahedronMesher(const RankedPoints& points, const TetrahedronReader& reader, StripOptions options);

    /// Tetrahedra come in order. Before each of a new lowest corner, the corners before are closed. Throws
    /// Error(kInput) where three tetrahedra share a triangle, or two lie on the same side of it.
    void add(const RankedTetrahedron& tetrahedron);
    /// No tetrahedron that comes has a corner before `rank`: finishes what has one. Where only one tetrahedron had a
    /// triangle, it lies on the hull.
    void close_before(std::uint32_t rank);
    void close_all() { close_before(points_.size()); }

    /// Made since the last begin_strip().
    const MeshedStrip& strip() const { return made_; }
    void begin_strip(std::uint32_t strip);
    /// Vertices that were finished since this was cleared.
    std::vector<VertexEnd>& ended() { return ended_; }

    /// Of the front, and of what the strip has made.
    std::uint64_t bytes() const;
    /// Whether all faces on the hull lie on the sides of the box round the points, and no more than four labels meet
    /// on an edge or corner of it, with those of the sides.
    bool hull_is_box() const { return hull_is_box_; }
    /// When all are closed.
    LabelOracle oracle() const { return {euler_, quadruple_points_, pairs_.size()}; }

private:
    struct Note {
        std::uint32_t vertex = kNoRank, last_strip = 0;
        Label label = 0;          // of the first tetrahedron at a triangle
        std::uint8_t seen = 0;    // tetrahedra at a triangle
        std::uint8_t labels = 0;  // at a node or edge, in tetrahedra; many are one more than four
        bool is_outward = false;  // a triangle, in the order of ranks, from its first tetrahedron
        bool is_on_hull = false;
        bool is_shared = false;  // by strips
    };
    struct Nothing {};
    using Places = std::array<std::uint32_t, 16>;  // in the table, by CornerSet

    Places open_simplices(const RankedTetrahedron& tetrahedron);
    void mesh(const RankedTetrahedron& tetrahedron, const Places& places);
    void count_cell(const RankedTetrahedron& tetrahedron, const Places& places);
    void meet_triangle(const RankedTetrahedron& tetrahedron, int opposite, std::uint32_t place);
    [[noreturn]] void fail_at(const SimplexKey& triangle, const char* text) const;
    template <class VertexOf, class MiddleOf>
    void add_patch(const CasePatch& patch, bool turn, const std::array<Label, 2>& labels, VertexOf&& vertex_of,
                   MiddleOf&& middle_of);
    void close_triangle(std::uint32_t place);
    void finish(std::uint32_t place);
    void cap(std::uint32_t place, const SimplexKey& corners);
    void count_boundary(std::uint32_t rank);
    void add_face(const SimplexKey& corners, Label first, Label second);
    std::uint32_t place_of(const SimplexKey& corners) { return simplices_.find_or_add(corners); }
    std::uint32_t vertex(std::uint32_t place);
    std::uint32_t inner_vertex(const RankedTetrahedron& tetrahedron);
    std::uint32_t make_vertex(std::span<const std::uint32_t> corners);
    Vec3 centroid(std::span<const std::uint32_t> corners) const;
    SideSet sides_of(std::span<const std::uint32_t> corners) const;
    std::int64_t& euler(Label label);

    const RankedPoints& points_;
    const TetrahedronReader& reader_;
    bool has_cell_labels_;
    StripOptions options_;
    TetrahedronPatches tetrahedron_patches_ = make_tetrahedron_patches();
    TrianglePatches triangle_patches_ = make_triangle_patches();

    std::uint32_t strip_ = 0, closed_ = 0;
    MeshedStrip made_;
    std::vector<VertexEnd> ended_;
    OpenSimplices<Note> simplices_;
    OpenSimplices<Nothing> label_uses_;  // corners of a node or edge, and a label of a tetrahedron there, behind them
    std::vector<bool> is_used_;          // points, by rank
    bool hull_is_box_ = true;
    std::uint64_t quadruple_points_ = 0;
    std::vector<std::int64_t> euler_;
    LabelPairs pairs_;
};

}  // namespace regionmesh
