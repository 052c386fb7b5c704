// Turns tetrahedra into faces in the order of the sweep, holding the simplices that later ones may share (P 3.9).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "cells/active_simplices.h"
#include "cells/label_pairs.h"
#include "cells/marching_tetrahedra.h"
#include "cells/ranked_tetrahedra.h"
#include "cells/strip_mesher.h"
#include "regionmesh/label_oracle.h"
#include "surface/chunk.h"

namespace regionmesh {

/// A vertex whose faces have all been made.
struct FinalizedVertex {
    std::uint32_t vertex, last_strip;  // the strip of the last of its faces
    bool is_on_hull;
    bool is_shared;          // several strips use it
    bool is_pinned = false;  // may not move or be collapsed

    friend bool operator<(const FinalizedVertex& a, const FinalizedVertex& b) { return a.vertex < b.vertex; }
};

/// The surface of one strip. Vertex numbers run through all strips; the first new one is `first_vertex`.
struct MeshedStrip {
    std::uint32_t first_vertex = 0;
    std::vector<ChunkVertex> vertices;  // vertices with the sides of the box that all corners lie on
    std::vector<ChunkFace> faces;       // second label on the hull: exterior of the side of the box, or kHull
};

/// Labels at the points: the five cases of Nielson and Franke, with vertices at centroids of edges, triangles and
/// tetrahedra, known by their sorted corners; faces on the hull are cut by the labels of their corners. Labels of the
/// tetrahedra: the triangles between two labels, and those on the hull. Also counts the invariants of the mesh from the
/// labels (LabelOracle). With labels at the points the Euler characteristic of a region's boundary is
/// 2 (N0 - N1 + N2 - N3) over the simplices all of whose corners have the label; else N0 - N1 + N2 over those that a
/// tetrahedron of the label shares with another label or the exterior.
class TetrahedronMesher {
public:
    /// Holds references to the points, and to the reader for the names of its points.
    TetrahedronMesher(const RankedPoints& points, const TetrahedronReader& reader, StripOptions options);

    /// Tetrahedra come in order. Before the first one of a new lowest corner, finalize_before() is called. Throws
    /// Error(kInput) where three tetrahedra share a triangle, or two lie on the same side of it.
    void add(const RankedTetrahedron& tetrahedron);
    /// No tetrahedron to come has a corner before `rank`: finalizes the simplices that have one. A triangle that only
    /// one tetrahedron has lies on the hull.
    void finalize_before(std::uint32_t rank);
    void finalize_all() { finalize_before(points_.size()); }

    /// The surface made since the last begin_strip().
    const MeshedStrip& strip() const { return made_; }
    void begin_strip(std::uint32_t strip);
    /// Vertices finalized since this was cleared.
    std::vector<FinalizedVertex>& finalized() { return finalized_; }

    /// Bytes of the active simplices and of the strip.
    std::uint64_t bytes() const;
    /// Whether all faces on the hull lie on the sides of the box round the points, and no more than four labels meet
    /// on an edge or corner of it, with those of the sides.
    bool hull_is_box() const { return hull_is_box_; }
    /// Valid after finalize_all().
    LabelOracle oracle() const { return {euler_, quadruple_points_, pairs_.size()}; }

private:
    struct Note {
        std::uint32_t vertex = kNoRank, last_strip = 0;
        Label label = 0;          // label of the first tetrahedron at a triangle
        std::uint8_t seen = 0;    // tetrahedra at a triangle
        std::uint8_t labels = 0;  // number of labels of tetrahedra at a node or edge; at most one more than four
        bool is_outward = false;  // a triangle, in the order of ranks, from its first tetrahedron
        bool is_on_hull = false;
        bool is_shared = false;  // several strips use it
    };
    struct Nothing {};
    using Places = std::array<std::uint32_t, 16>;  // indices in the table, one per CornerSet

    Places find_simplices(const RankedTetrahedron& tetrahedron);
    void mesh(const RankedTetrahedron& tetrahedron, const Places& places);
    void count_cell(const RankedTetrahedron& tetrahedron, const Places& places);
    void meet_triangle(const RankedTetrahedron& tetrahedron, int opposite, std::uint32_t place);
    [[noreturn]] void fail_at(const SimplexKey& triangle, const char* text) const;
    template <class VertexOf, class MiddleOf>
    void add_patch(const CasePatch& patch, bool turn, const std::array<Label, 2>& labels, VertexOf&& vertex_of,
                   MiddleOf&& middle_of);
    void finalize_triangle(std::uint32_t place);
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

    std::uint32_t strip_ = 0, finalized_ranks_ = 0;
    MeshedStrip made_;
    std::vector<FinalizedVertex> finalized_;
    ActiveSimplices<Note> simplices_;
    ActiveSimplices<Nothing> label_uses_;  // corners of a node or edge, then a label of a tetrahedron there
    std::vector<bool> is_used_;            // points, by rank
    bool hull_is_box_ = true;
    std::uint64_t quadruple_points_ = 0;
    std::vector<std::int64_t> euler_;
    LabelPairs pairs_;
};

}  // namespace regionmesh
