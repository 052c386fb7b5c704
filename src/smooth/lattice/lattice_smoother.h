// Smooths the surface of a lattice inside its simplices: keeps every sample in its region by construction.
#pragma once

#include <deque>

#include "smooth/chunk_smoother.h"
#include "smooth/lattice/lattice_level.h"
#include "smooth/lattice/lattice_lines.h"
#include "smooth/lattice/lattice_sites.h"
#include "smooth/packed_chunks.h"

namespace regionmesh {

/// How many samples along x, y and z from a vertex, at most, the lattice filter reads labels for its position.
std::array<std::uint32_t, 3> lattice_reach(const SmoothOptions& options, const LatticeFrame& frame);

/// New positions of the vertices of a reconstruction, each strictly inside its lattice simplex: see
/// docs/explanation/smoothing.md. Requires a surface made by StripMesher with QuadCuts::kCones: other cuts can
/// cross. The sites of a chunk are made, their normals averaged, the levels refined, the vertices placed and the lines
/// swept, each as soon as the chunks that follow have come as far as it reads. Whether the surface comes in chunks or
/// as one gives the same positions, bit for bit. Each array holds the chunks between the first stage that writes it and
/// the last that reads it; vertices and faces are packed in between (packed_chunks.h).
class LatticeSmoother final : public ChunkSmoother {
public:
    LatticeSmoother(const SmoothOptions& options, const ChunkOrder& order);
    LatticeSmoother(const LatticeSmoother&) = delete;
    LatticeSmoother& operator=(const LatticeSmoother&) = delete;

    /// Always true. Requires the simplices of the vertices (Chunk::simplices).
    [[nodiscard]] bool add(const Chunk& chunk, bool is_last, double next_low) override;
    bool next(Chunk& chunk) override;

    std::uint32_t most_chunks() const override;
    double safe_high() const override;
    const SmoothReport& report() const override { return report_; }

private:
    void add_to_levels(std::uint32_t chunk);
    void refine();
    double weight_on_edge(int kind, std::uint32_t site) const;
    void place(std::uint32_t chunk);
    void place_on_line(const LatticeSimplex& simplex, std::uint32_t first_site);
    void move_vertices(std::uint32_t chunk, Chunk& moved);
    void drop_sites();
    /// Chunks that a stage may have done when the one before has done `done_before` and must be one chunk ahead.
    std::uint32_t one_behind(std::uint32_t done_before) const;
    void note_bytes();

    SmoothOptions options_;
    ChunkOrder order_;
    Vec3 spacing_;  // in finest spacings
    LatticeMargins margins_;
    PackedChunks chunks_;
    LatticeSites sites_;
    SlidingPages<SiteEstimate> estimates_;  // by site; until its vertex is placed
    std::deque<LatticeLevel> levels_;       // coarse to fine
    LatticeLines lines_;
    // Of placed vertices that are not in lines_ the weight of the second node, in order.
    SlidingPages<std::uint32_t> weights_;
    SlidingArray<std::uint32_t> first_weight_;          // by chunk, and one more
    std::vector<Vec3> before_, after_;                  // positions of the vertices of the chunk that is moved
    std::vector<Vec3> carried_before_, carried_after_;  // and of those carried to the chunk that is next out
    PackedChunks::Parts parts_;                         // of the chunk in hand
    SlidingArray<double> next_low_;                     // by chunk
    SlidingArray<std::int64_t> last_layer_;             // by chunk: of the finest level
    bool is_last_ = false;
    std::uint32_t added_sites_ = 0;  // to the levels
    std::uint32_t made_ = 0, averaged_[LatticeSites::kNormalPasses] = {}, added_ = 0, placed_ = 0, linked_ = 0,
                  swept_[LatticeLines::kSweeps] = {}, released_ = 0;
    SmoothReport report_;
};

}  // namespace regionmesh
