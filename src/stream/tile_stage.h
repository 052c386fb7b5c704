// Decimates each chunk in tiles, before it is merged (docs/explanation/tiles.md, "The first stage").
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
    /// Coarsens the caps of the chunk, and decimates it up to a fixed cost; never below what the target leaves. If
    /// the target is near, and a chunk before had few free collapses, only coarsens the caps: the second stage takes
    /// less time for the other collapses. Returns the chunk that is left. If its faces were decimated, the gathered
    /// chunk keeps its arrays.
    Chunk run(GatheredStrips& gathered);

private:
    /// Sets the shares of what is left to those of the faces that are left.
    void coarsen_caps(GatheredStrips& gathered, TileOptions& options) const;

    const Plan& plan_;
    TileOptions tile_options_;
    RunLog& log_;
    std::uint32_t strips_done_ = 0;
    bool had_few_free_ = false;  // a chunk of kFreeTrialFaces or more
    bool coarsens_caps_;
    bool is_on_;
};

}  // namespace regionmesh
