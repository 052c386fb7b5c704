#include "stream/tile_stage.h"

#include <algorithm>

#include "stream/stage_options.h"
#include "stream/tuning.h"

namespace regionmesh {

TileStage::TileStage(const Plan& plan, const ReconstructOptions& options, double scale, RunLog& log)
    : plan_(plan), log_(log) {
    const double share = plan.target.share();
    is_on_ = plan.is_decimating && share * stream::kFreeMargin < 1;
    tile_options_ = {.cost_level = stream::kTileCost,
                     .keep_share = std::min(share * stream::kTileMargin, 1.0),
                     .free_share = share > stream::kFreeFrom ? share * stream::kFreeMargin : 1,
                     .threads = options.threads,
                     .in_flight = plan.budget.in_flight,
                     .decimate = decimate_options(options, scale)};
}

void TileStage::run(Chunk& chunk, const Gatherer& gatherer) {
    if (!is_on_) return;
    const Timer timer = log_.time("decimate tiles");
    const SafeInterval safe = gatherer.safe();
    log_.add(decimate_tiles(chunk, gatherer.carried(), {safe.low, safe.high}, plan_.tiles, tile_options_));
}

}  // namespace regionmesh
