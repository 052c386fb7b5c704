// Decimates each chunk in tiles, before it is merged (docs/tiles.md, "The first stage").
#pragma once

#include "stream/gatherer.h"
#include "stream/plan.h"

namespace regionmesh {

class TileStage {
public:
    TileStage(const Plan& plan, const ReconstructOptions& options, const SourceShape& shape, RunLog& log);

    /// Whether caps are coarsened in all chunks; else in none. Tetrahedra stay those of the paper, and of the same
    /// tetrahedra from a file. Where a near target needs faces of the caps, some chunks would be coarsened and others
    /// not: the mesh would have bands.
    static bool may_coarsen_caps(const SourceShape& shape, const Target& target);
    /// Whether run() does anything.
    bool is_on() const { return is_on_; }
    /// Coarsens the caps of the chunk, and decimates it up to a fixed cost; never below what the target leaves. Where
    /// the target allows only collapses at zero cost, and chunks so far had few, makes none: the trim makes those few
    /// in less time.
    void run(GatheredStrips& gathered);

private:
    /// Sets the shares of what is left to those of the faces that are left.
    void coarsen_caps(GatheredStrips& gathered, TileOptions& options) const;
    bool has_few_free() const;

    const Plan& plan_;
    TileOptions tile_options_;
    RunLog& log_;
    std::uint32_t strips_done_ = 0;
    std::uint64_t given_ = 0, left_ = 0;  // faces of the chunks so far
    bool coarsens_caps_;
    bool is_on_;
};

}  // namespace regionmesh
