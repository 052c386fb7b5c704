// Merges the chunks into the model, keeps it within the budget and brings it to the target (docs/explanation/tiles.md,
// "The second stage").
#pragma once

#include "regionmesh/simplify.h"
#include "stream/merger.h"
#include "stream/plan.h"
#include "stream/run_log.h"

namespace regionmesh {

class SimplifyStage {
public:
    SimplifyStage(Mesh& mesh, const Plan& plan, const ReconstructOptions& options, const SourceShape& shape,
                  RunLog& log);

    /// True if memory has room for one more chunk while the tiles of the chunk to be merged next are decimated.
    bool has_room_ahead() const;
    /// Merges a chunk, which had `initial_faces` faces before its tiles were decimated.
    void merge(Chunk chunk, std::uint64_t initial_faces);
    /// Makes room for the next chunk. Faces to come lie at `safe_high` or beyond along the sweep.
    void keep_within_budget(double safe_high);
    /// When all chunks are merged. Makes the mesh.
    void bring_to_target();

private:
    void raise_threshold(std::uint64_t goal, double safe_high);
    void warn_of_memory(double faces, const char* stage);
    void take_mesh();
    void keep_floor(std::uint64_t goal);
    void trim(std::uint64_t goal, double safe_high, bool is_last);

    Mesh& mesh_;
    const Plan& plan_;
    const ReconstructOptions& options_;
    const SourceShape& shape_;
    RunLog& log_;
    Merger merger_;
    Budget budget_;
    std::uint32_t merged_chunks_ = 0;
    std::uint64_t initial_faces_ = 0;  // of the merged chunks, before any simplification
    std::uint64_t chunk_faces_ = 0;    // of the last chunk, when it was merged
    StopReason stopped_ = StopReason::kTarget;
    bool strips_are_done_ = false;
};

}  // namespace regionmesh
