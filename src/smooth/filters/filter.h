// What a smoothing filter has to provide; smooth/filters/filters.cpp has the table of them.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>

#include "regionmesh/lattice.h"
#include "regionmesh/smooth.h"
#include "smooth/chunk_stars.h"
#include "smooth/filters/neighbours.h"
#include "smooth/lattice/lattice_simplex.h"
#include "smooth/surface_window.h"

namespace regionmesh {

/// How chunks follow each other: the axis of the sweep, and the thickness of the thinnest along it. The default is a
/// surface that is wholly in core, as one chunk.
struct ChunkOrder {
    int axis = 2;
    double thickness = std::numeric_limits<double>::infinity();
    std::uint32_t overlap = 0;               // chunks that follow and begin before the end of one, at most
    std::uint32_t extra = 0;                 // chunks held beyond those that the reach of the filter calls for
    LatticeFrame frame = {};                 // frame of the vertices; for SmoothFilter::kLattice
    CellKind cells = CellKind::kTetrahedra;  // that the surface is made of, for the same
    Box wanted{{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}, {HUGE_VAL, HUGE_VAL, HUGE_VAL}};  // for the same: positions of
                                                                                    // vertices outside are not needed

    std::uint32_t chunks_within(double length) const {
        return static_cast<std::uint32_t>(std::ceil(length / thickness));
    }
};

/// What filters read.
struct FilterInput {
    const SurfaceWindow& window;
    const Neighbours& neighbours;
    const SmoothOptions& options;
    ChunkOrder order;
};

/// A filter works in passes over the chunks of the window. Two positions are kept for each vertex: pass k reads one and
/// writes the other, over what pass k - 1 read; both are the origins before pass 0.
class Filter {
public:
    virtual ~Filter() = default;

    /// Farthest that a vertex may go along the sweep, in units of the larger of scale and chunk thickness.
    virtual double farthest() const = 0;
    virtual std::uint32_t pass_count() const = 0;
    /// Chunks by which the pass before must be ahead. Pass 0 follows the search for neighbours.
    virtual std::uint32_t chunks_ahead(std::uint32_t pass) const = 0;
    /// Runs a pass over the vertices of a chunk.
    virtual void run(std::uint32_t pass, std::uint32_t chunk, const SlidingArray<Vec3>& from,
                     SlidingArray<Vec3>& to) = 0;

    /// Notes the faces of a chunk that has just been added to the window.
    virtual void note_chunk(std::uint32_t) {}
    /// Notes the stars of the vertices of a chunk, in the order of chunks.
    virtual void note_stars(const ChunkStars&) {}
    /// Does a pass read neighbours of vertices of chunks before its own?
    virtual bool reads_earlier_neighbours() const { return false; }
    /// Vertices before `v` and faces before `f` are not in the window any more.
    virtual void drop_before(std::uint32_t /*v*/, std::uint32_t /*f*/) {}
    virtual std::size_t bytes() const { return 0; }
};

std::unique_ptr<Filter> make_filter(const FilterInput& input);

/// Bytes per face of the window of a filter, of a volume or a strip with so many faces a sample; `shared` are those
/// that all filters with passes keep.
std::uint64_t window_bytes_per_face(SmoothFilter filter, double faces_per_sample, std::uint64_t shared);

}  // namespace regionmesh
