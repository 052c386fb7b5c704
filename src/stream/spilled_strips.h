// Spills strips of faces to disk and reads them back in order, as chunks (P 3.9).
#pragma once

#include <cstdint>
#include <vector>

#include "base/external_sort.h"
#include "base/temporary_file.h"
#include "cells/tetrahedron_mesher.h"
#include "surface/chunk.h"

namespace regionmesh {

/// Consecutive strips.
struct StripRange {
    std::uint32_t first, end;
};

/// Which vertices a strip leaves active is known only when later strips are meshed. So strips are spilled with vertex
/// numbers that run through all of them, and become chunks when they are read back. Holds some bytes per strip, and the
/// active vertices.
class SpilledStrips {
public:
    explicit SpilledStrips(std::uint64_t sort_bytes) : finalized_(sort_bytes) {}

    /// Strips come in order, each with the vertices finalized since the one before. `top` is the highest vertex
    /// along the sweep.
    void add(const MeshedStrip& strip, double top);
    void add_finalized(const FinalizedVertex& end);
    /// After the last strip. Vertices on the hull lie on sides of a box, or else on no side but kHull.
    void finish(bool hull_is_box);

    std::uint32_t strip_count() const { return static_cast<std::uint32_t>(strips_.size()); }
    std::uint64_t face_count() const;
    std::uint64_t faces_of(StripRange strips) const;
    double top_of(StripRange strips) const;
    /// Consecutive ranges of the fewest strips each such that no vertex has faces in more than two of them.
    std::vector<StripRange> strips_for_smoothing() const;

    /// Returns to the first strip.
    void rewind();
    /// The faces of the strips that come next, as one chunk.
    void read(StripRange strips, Chunk& chunk);
    std::uint64_t bytes() const {
        return strips_.capacity() * sizeof(Strip) + active_.capacity() * sizeof(Active) + finalized_.bytes();
    }

private:
    struct Strip {
        std::uint64_t offset, faces;
        std::uint32_t first_vertex, vertices;
        std::uint32_t reach;  // last strip with a face of one of its vertices
        double top;
    };
    struct Active {
        std::uint32_t vertex, last_strip;
    };

    void make_local(Chunk& chunk, std::uint32_t first_vertex) const;
    SideSet sides_of(SideSet of_box, bool is_on_hull, bool is_pinned) const;

    TemporaryFile file_;
    std::vector<Strip> strips_;
    ExternalSort<FinalizedVertex> finalized_;
    bool hull_is_box_ = true;
    FinalizedVertex next_finalized_{};
    bool has_finalized_ = false;
    std::vector<Active> active_;  // after the strips read, in order of vertices
};

}  // namespace regionmesh
