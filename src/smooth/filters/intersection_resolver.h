// Resolves the intersections of smoothed faces, exactly, by backtracking (docs/explanation/smoothing.md, "The guard").
#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "mesh/face_meeting.h"
#include "mesh/sorted_face_tree.h"
#include "smooth/filters/backtrack.h"
#include "smooth/islands.h"
#include "smooth/shells.h"

namespace regionmesh {

/// Takes in the chunks one after the other. After each, all faces so far are valid: no face is turned over or of too
/// low quality, no face crosses another, no separate part of the surface has changed sides of another, and, where the
/// surface is wholly in core, no shell is turned inside out. Where one would, its vertices backtrack, and this repeats
/// until all faces are valid. Terminates: the unsmoothed surface is valid. Vertices of released chunks do not move.
class IntersectionResolver {
public:
    IntersectionResolver(const SurfaceWindow& window, StepLengths& steps, const SmoothOptions& options)
        : window_(window), steps_(steps), options_(options) {}

    /// Requires that the chunk has been through all rounds of backtracking, and that the next one was noted, if there
    /// is one. Returns false where only vertices of released chunks are left to backtrack: the window holds too few
    /// chunks. Never while no chunk was released.
    [[nodiscard]] bool add_chunk(std::uint32_t chunk);
    /// Notes the faces of a chunk that has just been added to the window.
    void note_chunk(std::uint32_t chunk) {
        if (options_.intersect_check) parts_.add_chunk(window_, chunk);
    }
    /// The window holds the whole surface, as one chunk.
    void note_whole() {
        if (options_.intersect_check) shells_.emplace(window_);
    }
    /// Releases the chunks before this one: their vertices do not move any more, and their faces are not tested again.
    void release_before(std::uint32_t chunk);
    /// Vertices before this one are not in the window any more.
    void drop_before(std::uint32_t v) {
        if (options_.intersect_check) parts_.drop_before(v);
    }

    std::uint64_t crossings() const { return crossings_; }  // pairs of faces found crossing, in all
    std::uint64_t islands() const { return islands_; }      // parts found to change sides
    std::size_t bytes() const;

private:
    struct ChunkTree {
        std::uint32_t chunk, first_face;
        Box bounds;
        SortedFaceTree tree;  // over the boxes of each face, from its origin to its smoothed position
    };
    struct Pair {
        std::uint32_t f, g;
    };

    void build_tree(std::uint32_t chunk);
    bool request_faulty_shapes(const std::vector<std::uint32_t>& faces);
    bool request_crossings(const std::vector<std::uint32_t>& faces, NumberRange whole);
    bool request_islands();
    bool request_inverted();
    bool is_unsmoothed(std::uint32_t f) const;
    void request(std::uint32_t v);
    void request_corners(std::uint32_t f);
    std::vector<std::uint32_t> apply_requests();
    PlacedFace placed(std::uint32_t f) const;
    template <class Visit>
    void for_near(const Box& box, Visit&& visit) const;

    const SurfaceWindow& window_;
    StepLengths& steps_;
    const SmoothOptions& options_;
    Parts parts_;
    std::optional<Shells> shells_;
    std::vector<std::uint32_t> island_vertices_;  // one vertex of each complete part, in chunks not released
    std::deque<ChunkTree> trees_;
    std::uint32_t first_movable_ = 0;  // first chunk whose vertices may backtrack
    std::uint32_t resolved_end_ = 0;
    std::vector<std::uint32_t> requested_;  // vertices that backtrack next, once each
    std::uint64_t crossings_ = 0, islands_ = 0;
};

}  // namespace regionmesh
