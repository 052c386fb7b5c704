#include "stream/tile_stage.h"

#include <algorithm>
#include <cmath>

#include "simplify/tuning.h"
#include "stream/stage_options.h"

namespace regionmesh {

TileStage::TileStage(const Plan& plan, const ReconstructOptions& options, const SourceShape& shape, RunLog& log)
    : plan_(plan), log_(log) {
    const double share = plan.target.share();
    is_on_ = plan.is_decimating && share * kFreeMargin < 1;
    tile_options_ = {.threshold = kTileThreshold,
                     .keep_share = std::min(share * kTileMargin, 1.0),
                     .free_share = share > kFreeFrom ? share * kFreeMargin : 1,
                     .threads = options.threads,
                     .in_flight = plan.budget.in_flight,
                     .simplify = simplify_options(options, shape)};
}

void TileStage::run(GatheredStrips& gathered) {
    if (!is_on_) return;
    if (has_few_free()) return log_.note_strips_through(WorkStage::kTiles, gathered.end);
    tile_options_.on_share = [&](double share) {
        log_.note_strips_through(WorkStage::kTiles, strips_done_ + share * (gathered.end - strips_done_));
    };
    tile_options_.faces_in_flight = static_cast<std::uint64_t>(
        std::ceil(plan_.budget.share_in_flight * static_cast<double>(gathered.chunk.faces.size())));
    const StageTimer timer = log_.time("decimate tiles");
    given_ += gathered.chunk.faces.size();
    log_.add(simplify_run(gathered.chunk, gathered.carried, gathered.safe, plan_.tiles, tile_options_));
    left_ += gathered.chunk.faces.size();
    strips_done_ = gathered.end;
}

bool TileStage::has_few_free() const {
    return tile_options_.keep_share >= 1 && given_ >= kFreeTrialFaces &&
           static_cast<double>(left_) > (1 - kLeastFreeGain) * static_cast<double>(given_);
}

}  // namespace regionmesh
