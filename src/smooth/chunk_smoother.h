// Smoothing of a surface that comes in chunk by chunk: what all ways of doing it provide.
#pragma once

#include <memory>
#include <optional>
#include <span>

#include "regionmesh/smooth.h"
#include "smooth/filters/filter.h"
#include "smooth/surface_window.h"

namespace regionmesh {

/// The same chunks come out as went in, later; only positions differ. The result depends on the chunks, not on when
/// they are taken out.
class ChunkSmoother {
public:
    virtual ~ChunkSmoother() = default;

    /// Adds the next chunk; vertices to come lie at `next_low` or beyond along the sweep. Returns false where the
    /// window turns out to hold too few chunks (ChunkOrder::extra); then this object is of no more use, and
    /// stuck_chunk() says where.
    [[nodiscard]] virtual bool add(const Chunk& chunk, bool is_last, double next_low) = 0;
    /// Takes out the next chunk whose positions are final; false when there is none yet.
    virtual bool next(Chunk& chunk) = 0;

    /// Most chunks held at a time.
    virtual std::uint32_t most_chunks() const = 0;
    virtual std::optional<std::uint32_t> stuck_chunk() const { return {}; }
    /// The high end of the safe interval: all surface that was not taken out lies here or beyond along the sweep,
    /// however it is smoothed.
    virtual double safe_high() const = 0;

    virtual const SmoothReport& report() const = 0;
};

/// Requires options.passes > 0, and a filter that is not kAuto.
std::unique_ptr<ChunkSmoother> make_chunk_smoother(const SmoothOptions& options, const ChunkOrder& order);

/// Throws Error(kUsage) for numbers that no filter can work with.
void require_in_range(const SmoothOptions& options);

/// Throws Error(kUsage) for SmoothFilter::kLattice, where the surface is not one of sections.
void require_no_lattice(const SmoothOptions& options);

/// Positions of the vertices of a chunk before and after smoothing, by local number.
struct MovedChunk {
    std::uint32_t carried;
    std::span<const Vec3> before, after;
    std::span<const ChunkFace> faces;
};

/// Adds the displacements and volumes of a chunk of final positions to a report.
void note_chunk(const MovedChunk& chunk, SmoothReport& report);
void note_chunk(const SurfaceWindow& window, std::uint32_t chunk, const SlidingArray<Vec3>& positions,
                SmoothReport& report);

}  // namespace regionmesh
