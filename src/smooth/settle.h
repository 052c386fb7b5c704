// The last of the guard: smoothed faces that cross, exactly, until none does (DESIGN 8).
#pragma once

#include <deque>
#include <string>
#include <vector>

#include "mesh/face_meeting.h"
#include "mesh/sorted_face_tree.h"
#include "regionmesh/error.h"
#include "smooth/islands.h"
#include "smooth/step_back.h"

namespace regionmesh {

/// Thrown where only vertices that were let go are left to step back: hold more layers, and begin again.
class HeldTooFew : public Error {
public:
    explicit HeldTooFew(std::uint32_t layer)
        : Error(ErrorCode::kInput,
                "smoothing: strip " + std::to_string(layer) +
                    " cannot be made sound without strips that were let go; smooth with fewer passes") {}
};

/// Takes in one layer after the other. After each, all faces so far are sound: none is turned over or bad, none crosses
/// another, no separate part of the surface has changed sides of another. Where one would, its vertices step back, and
/// so on, until all is sound: the surface as it was is. Vertices of layers that were let go stand fast.
class Settling {
public:
    Settling(const SurfaceWindow& window, Stand& stand, const SmoothOptions& options)
        : window_(window), stand_(stand), options_(options) {}

    /// Requires that the layer has been through all rounds of stepping back, and the next one was noted, if there is
    /// one. Throws HeldTooFew.
    void add_layer(std::uint32_t layer);
    /// Notes the faces of a layer that has just come in.
    void note_layer(std::uint32_t layer) {
        if (options_.intersect_check) parts_.add_layer(window_, layer);
    }
    /// From now on vertices of layers before this one stand fast, and their faces are met no more.
    void let_go_before(std::uint32_t layer);
    /// Vertices before this one are asked for no more.
    void drop_before(std::uint32_t v) {
        if (options_.intersect_check) parts_.drop_before(v);
    }

    std::uint64_t crossings() const { return crossings_; }  // pairs of faces found crossing, in all
    std::uint64_t islands() const { return islands_; }      // parts found to change sides
    std::size_t bytes() const;

private:
    struct LayerTree {
        std::uint32_t layer, first_face;
        Box bounds;
        SortedFaceTree tree;  // over the boxes of each face, from where it came to where smoothing took it
    };
    struct Pair {
        std::uint32_t f, g;
    };

    void build_tree(std::uint32_t layer);
    bool raise_faulty_shapes(const std::vector<std::uint32_t>& faces);
    bool raise_crossing(const std::vector<std::uint32_t>& faces, NumberRange whole);
    bool raise_islands();
    bool is_as_it_came(std::uint32_t f) const;
    void raise(std::uint32_t v);
    void raise_corners(std::uint32_t f);
    std::vector<std::uint32_t> step_back_raised();
    PlacedFace placed(std::uint32_t f) const;
    template <class Visit>
    void for_near(const Box& box, Visit&& visit) const;

    const SurfaceWindow& window_;
    Stand& stand_;
    const SmoothOptions& options_;
    Parts parts_;
    std::vector<std::uint32_t> speakers_;  // one vertex of each complete part, in layers not let go
    std::deque<LayerTree> trees_;
    std::uint32_t first_free_ = 0;  // first layer whose vertices may step back
    std::uint32_t settled_end_ = 0;
    std::vector<std::uint32_t> raised_;  // vertices that step back next, once each
    std::uint64_t crossings_ = 0, islands_ = 0;
};

}  // namespace regionmesh
