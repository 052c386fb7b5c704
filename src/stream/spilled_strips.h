// Strips of faces, put aside on disk and read back in order (P 3.9).
#pragma once

#include <cstdint>
#include <vector>

#include "base/external_sort.h"
#include "base/temporary_file.h"
#include "cells/tetrahedron_mesher.h"
#include "mesh/chunk.h"

namespace regionmesh {

/// So many strips that follow one another.
struct StripRange {
    std::uint32_t first, end;
};

/// Keeps meshed strips, and brings them back as batches: a vertex is finalized with the last of its faces. Holds some
/// bytes a strip, and those vertices that are open.
class SpilledStrips {
public:
    explicit SpilledStrips(std::uint64_t sort_bytes) : ends_(sort_bytes) {}

    /// Strips come in order, with the vertices that have ended since the one before; they reach up to `top` along the
    /// sweep.
    void add(const MeshedStrip& strip, double top);
    void add_end(const VertexEnd& end);
    /// No more come. What lies on the hull lies on sides of a box, or else on no side but kHull.
    void finish(bool hull_is_box);

    std::uint32_t strip_count() const { return static_cast<std::uint32_t>(strips_.size()); }
    std::uint64_t face_count() const;
    std::uint64_t faces_of(StripRange strips) const;
    double top_of(StripRange strips) const;
    /// Layers of the fewest strips each such that no vertex has faces in more than two, one after the other.
    std::vector<StripRange> layers() const;

    /// Begins again with the first.
    void rewind();
    /// The faces of the strips that come next, as a batch.
    void read(StripRange strips, Chunk& batch);
    std::uint64_t bytes() const {
        return strips_.capacity() * sizeof(Strip) + open_.capacity() * sizeof(Open) + ends_.bytes();
    }

private:
    struct Strip {
        std::uint64_t offset, faces;
        std::uint32_t first_vertex, vertices;
        std::uint32_t reach;  // the last strip that has a face of one of its vertices
        double top;
    };
    struct Open {
        std::uint32_t vertex, last_strip;
    };

    SideSet sides_of(SideSet of_box, bool is_on_hull, bool is_pinned) const;

    TemporaryFile file_;
    std::vector<Strip> strips_;
    ExternalSort<VertexEnd> ends_;
    bool hull_is_box_ = true;
    VertexEnd next_end_{};
    bool has_end_ = false;
    std::vector<Open> open_;  // after the strips read, in order of vertices
    std::vector<ChunkVertex> vertices_;
    std::vector<ChunkFace> faces_;
};

}  // namespace regionmesh
