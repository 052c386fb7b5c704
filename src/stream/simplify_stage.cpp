#include "stream/simplify_stage.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "judge/error_bound.h"
#include "regionmesh/improve.h"
#include "simplify/decimate.h"
#include "stream/footprint.h"
#include "stream/stage_options.h"
#include "stream/tuning.h"

namespace regionmesh {

SimplifyStage::SimplifyStage(Mesh& mesh, const Plan& plan, const ReconstructOptions& options, const SourceShape& shape,
                             RunLog& log)
    : mesh_(mesh), plan_(plan), options_(options), shape_(shape), log_(log), budget_(plan.budget) {}

bool SimplifyStage::has_room_ahead() const { return budget_.has_room_ahead(merged_chunks_, merger_.face_count()); }

void SimplifyStage::merge(Chunk chunk, std::uint64_t initial_faces) {
    ++merged_chunks_;
    initial_faces_ += initial_faces;
    chunk_faces_ = chunk.faces.size();
    merger_.add(std::move(chunk));
    give_back_freed_memory();
    log_.note_faces_held(merger_.face_count());
    log_.note_bytes(merger_.face_count(), merger_.bytes());
}

void SimplifyStage::keep_within_budget(double safe_high) {
    const std::uint32_t next = merged_chunks_;
    const std::uint64_t face_budget = budget_.face_budget(next),
                        room = budget_.room_before(next, budget_.expected_faces(next, chunk_faces_));
    if (!plan_.is_decimating || merger_.face_count() <= room) return;
    const std::uint64_t goal =
        std::max(plan_.target.so_far(initial_faces_), std::min(room, face_budget * stream::kGoalTenths / 10));
    if (merger_.face_count() <= goal) return;
    raise_threshold(goal, safe_high);
    stopped_ = StopReason::kTarget;
    if (merger_.face_count() > room) {
        take_mesh();
        trim(goal, safe_high, false);
        merger_.put_back(mesh_);
        give_back_freed_memory();
    }
    // Where topology or the largest error forbid more, the mesh may grow.
    if (stopped_ == StopReason::kTarget || merger_.face_count() <= room) return;
    budget_.asked_budget = std::uint64_t{merger_.face_count()} * stream::kGrowthHalves / 2;
    const auto merged = static_cast<double>(std::max<std::uint64_t>(initial_faces_, 1));
    const double total = std::max(static_cast<double>(plan_.target.total.value_or(0)), merged);
    warn_of_memory(static_cast<double>(merger_.face_count()) * (total / merged), "reconstruct");
}

/// Says that the model will not fit, where it decimates so many faces in the end. Nobody can know before the work.
void SimplifyStage::warn_of_memory(double faces, const char* stage) {
    const double bytes = static_cast<double>(shape_.reading_bytes) + faces * static_cast<double>(kWorkBytesPerFace);
    if (options_.face_budget || bytes <= static_cast<double>(options_.memory)) return;
    log_.note_bytes_needed(static_cast<std::uint64_t>(bytes), stage);
}

void SimplifyStage::take_mesh() {
    const StageTimer timer = log_.time("reconstruct");
    mesh_ = plan_.is_decimating ? merger_.take_sorted_mesh(options_.threads) : merger_.take_mesh();
    give_back_freed_memory();
}

void SimplifyStage::bring_to_target() {
    if (!plan_.is_decimating) {
        take_mesh();
        return;
    }
    strips_are_done_ = true;
    log_.report_progress("decimate");
    warn_of_memory(static_cast<double>(merger_.face_count()), "decimate");
    const std::uint64_t goal = plan_.target.of(log_.report().initial_faces);
    raise_threshold(goal, HUGE_VAL);
    log_.advance(WorkStage::kPasses, 1);
    take_mesh();
    trim(goal, HUGE_VAL, true);
    keep_floor(goal);
    log_.report().stopped = stopped_;
    log_.report().error_bound = largest_error_bound(mesh_);
}

/// Cures the faces below the bound on quality that smoothing made and no collapse removed. Splits add a few faces: as
/// many go again.
void SimplifyStage::keep_floor(std::uint64_t goal) {
    {
        const StageTimer timer = log_.time("floor");
        log_.report().floor = raise_floor(mesh_, promises_of(options_, ground_of(shape_)));
    }
    if (stopped_ == StopReason::kTarget && mesh_.face_count() > goal) trim(goal, HUGE_VAL, true);
}

/// Brings the model near the goal, tile by tile.
void SimplifyStage::raise_threshold(std::uint64_t goal, double safe_high) {
    const StageTimer timer = log_.time("raise level");
    // The number of passes is not known: each is taken for half of what was left.
    double passes_done = 0;
    const auto on_share = [&](double share) {
        if (!strips_are_done_) return;
        const double done = passes_done + (1 - passes_done) / 2 * share;
        if (share == 1) passes_done = done;
        log_.advance(WorkStage::kPasses, done);
        log_.report_progress("decimate");
    };
    const TileOptions tile_options{.threshold = 0,
                                   .keep_share = 0,
                                   .threads = options_.threads,
                                   .in_flight = budget_.in_flight,
                                   .simplify = simplify_options(options_, shape_),
                                   .on_share = on_share};
    const PassOptions passes{.target_faces = goal, .safe = {.high = safe_high}, .tiles = tile_options};
    if (!is_worth_pass(merger_.face_count(), passes)) return;
    Chunk whole = merger_.take_chunk();
    give_back_freed_memory();
    log_.add(simplify_in_passes(whole, plan_.tiles, passes).verdicts);
    merger_.add(std::move(whole));
    give_back_freed_memory();
}

/// Brings the mesh to the goal exactly, in sweeps over all edges.
void SimplifyStage::trim(std::uint64_t goal, double safe_high, bool is_last) {
    const StageTimer timer = log_.time("decimate");
    SimplifyOptions own = simplify_options(options_, shape_);
    own.target_faces = static_cast<std::uint32_t>(std::min(goal, kMostFaces));
    own.bounds_regions = false;  // few collapses are left: not worth 4 bytes a face of the whole mesh
    const DecimatePlan plan{.tiles = plan_.tiles,
                            .last = {.limits = box_of({.high = safe_high}, shape_.axis()),
                                     .refresh = is_last,
                                     .threads = options_.threads,
                                     .is_large = true}};
    const std::uint64_t held = mesh_.face_count();
    own.on_progress = [&](std::uint64_t faces) {
        const auto gone = static_cast<double>(held - faces);
        if (is_last && held > goal) log_.advance(WorkStage::kTrim, gone / static_cast<double>(held - goal));
        log_.report_progress(is_last ? "decimate" : "reconstruct");
    };
    DecimateResult done;
    collapse_to_target(mesh_, plan, own, done);
    log_.add(done.verdicts);
    log_.report().refreshes += done.refreshes;
    stopped_ = done.stopped;
    log_.note_bytes(held, done.bytes);
}

}  // namespace regionmesh
