#include "stream/tile_stage.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "simplify/tiles/coarsen_caps.h"
#include "simplify/tuning.h"
#include "stream/stage_options.h"

namespace regionmesh {

bool TileStage::may_coarsen_caps(const SourceShape& shape, const Target& target) {
    if (shape.cells != CellKind::kCompact) return false;
    if (target.share() == 0) return true;
    const auto total = static_cast<double>(target.total.value_or(0));
    return total * (1 - target.share() * kFreeMargin) >= static_cast<double>(most_cap_faces(shape.lattice));
}

TileStage::TileStage(const Plan& plan, const ReconstructOptions& options, const SourceShape& shape, RunLog& log)
    : plan_(plan), log_(log), coarsens_caps_(may_coarsen_caps(shape, plan.target)) {
    const double share = plan.target.share();
    is_on_ = plan.is_decimating && share * kFreeMargin < 1 - kLeastFreeGain;
    tile_options_ = first_stage(simplify_options(options, shape), share, options.threads);
    tile_options_.in_flight = plan.budget.in_flight;
}

Chunk TileStage::run(GatheredStrips& gathered) {
    if (!is_on_) return std::move(gathered.chunk);
    TileOptions options = tile_options_;
    const StageTimer timer = log_.time("decimate tiles");
    if (coarsens_caps_ && !gathered.chunk.faces.empty()) coarsen_caps(gathered, options);
    if (had_few_free_ && options.keep_share >= kNearShare) {
        log_.note_strips_through(WorkStage::kTiles, gathered.end);
        return std::move(gathered.chunk);
    }
    options.on_share = [&](double share) {
        log_.note_strips_through(WorkStage::kTiles, strips_done_ + share * (gathered.end - strips_done_));
    };
    options.faces_in_flight = static_cast<std::uint64_t>(
        std::ceil(plan_.budget.share_in_flight * static_cast<double>(gathered.chunk.faces.size())));
    const std::size_t given = gathered.chunk.faces.size();
    TileResult done = simplify_chunk(gathered.chunk, gathered.carried, gathered.safe, plan_.tiles, options);
    log_.add(done.verdicts);
    strips_done_ = gathered.end;
    if (given < kFreeTrialFaces) return std::move(done.left);
    const double left = static_cast<double>(done.left.faces.size()) / static_cast<double>(given);
    // If half of the faces that free collapses may remove are gone, more collapses may be free.
    had_few_free_ = left > std::max(options.keep_share - kLeastFreeGain, (options.keep_share + options.free_share) / 2);
    return std::move(done.left);
}

/// What the target leaves is a share of the faces before.
void TileStage::coarsen_caps(GatheredStrips& gathered, TileOptions& options) const {
    const auto before = static_cast<double>(gathered.chunk.faces.size());
    const double least_share = std::min(options.keep_share, options.free_share);
    regionmesh::coarsen_caps(gathered.chunk, gathered.carried,
                             {.lattice = plan_.tiles.lattice,
                              .min_quality = options.simplify.promises.quality_bound(),
                              .least_faces = static_cast<std::uint64_t>(std::ceil(least_share * before)),
                              .threads = options.threads});
    const double left = static_cast<double>(gathered.chunk.faces.size()) / before;
    options.keep_share = std::min(options.keep_share / left, 1.0);
    options.free_share = std::min(options.free_share / left, 1.0);
}

}  // namespace regionmesh
