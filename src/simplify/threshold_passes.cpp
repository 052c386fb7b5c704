#include "simplify/threshold_passes.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "simplify/collapse_edges.h"

namespace regionmesh {
namespace {

/// Side in cells of cubes with about `tile_faces` faces each; along an axis that is shorter than the side there is one
/// tile, and `is_cut` is false.
double side_of_tiles(const TileGrid& grid, double tiles, std::array<bool, 3>& is_cut) {
    double side = 0;
    is_cut.fill(true);
    for (int round = 0; round < 3; ++round) {
        double cells = 1;
        int axes = 0;
        for (int axis = 0; axis < 3; ++axis)
            if (is_cut[axis]) cells *= grid.size[axis], ++axes;
        side = axes > 0 ? std::pow(cells / tiles, 1.0 / axes) : 0;
        for (int axis = 0; axis < 3; ++axis) is_cut[axis] = is_cut[axis] && grid.size[axis] > side;
    }
    return side;
}

/// Walls lie in each pass elsewhere: between those of the first stage where there is a lattice, and at golden sections
/// of a tile otherwise.
TileGrid grid_of(const TilePlan& plan, const PassOptions& options, std::uint64_t faces, int pass) {
    const int sweep = plan.sweep.axes[2];
    TileGrid grid{.origin = plan.lattice.origin,
                  .spacing = plan.lattice.spacing,
                  .size = {},
                  .cells = {},
                  .extent = box_of(options.safe, sweep),
                  .first_cell = plan.first_cell,
                  .is_bounded = plan.is_bounded};
    for (int axis = 0; axis < 3; ++axis) grid.size[axis] = plan.lattice.size[axis] - 1;
    std::array<bool, 3> is_cut;
    const double side = side_of_tiles(grid, std::max(static_cast<double>(faces) / options.tile_faces, 1.0), is_cut);
    for (int axis = 0; axis < 3; ++axis) {
        const std::uint32_t step = std::max(axis == sweep ? plan.run_strips : plan.tile_cells, 1u);
        const auto steps = static_cast<std::uint32_t>(std::max(std::round(side / step), 1.0));
        grid.cells[axis] = is_cut[axis] ? steps * step : std::max(grid.size[axis], 1u);
        if (!is_cut[axis]) continue;
        const std::uint32_t half = steps == 1 ? step / 2 : steps / 2 * step;
        grid.shift[axis] = (step / 2 + pass % 2 * half + pass / 2 * (step / 3)) % grid.cells[axis];
        if (!plan.is_bounded)
            grid.shift[axis] = static_cast<std::uint32_t>(std::fmod(0.618 * pass, 1.0) * grid.cells[axis]);
    }
    return grid;
}

/// The thresholds at which a sample of the tiles keeps a share of its faces, and not much less of the vertices that are
/// not locked.
class ThresholdSearch {
public:
    /// Shares down to `options.keep_share` can be found, those above `most` are of no interest.
    ThresholdSearch(TiledFaces& faces, const TileOptions& options, double most) {
        const std::vector<std::uint32_t> tiles = sample_of_tiles(faces);
        trial(faces, tiles, options, kFirstThreshold);
        if (left_.front() < most) trial(faces, tiles, options, kFirstThreshold / kThresholdRange);
    }

    /// All thresholds leave less: the collapses are free.
    bool is_free(double share) const { return left_.front() < share; }

    /// Between thresholds that were tried the share left is a power of the threshold.
    double at(double share) const {
        if (is_free(share)) return thresholds_.front();
        const auto after = std::ranges::find_if(left_, [&](double left) { return left < share; });
        if (after == left_.end()) return HUGE_VAL;
        const auto n = after - left_.begin();
        const double part = std::log(share / left_[n - 1]) / std::log(left_[n] / left_[n - 1]);
        return thresholds_[n - 1] * std::pow(kThresholdStep, part);
    }

private:
    void trial(TiledFaces& faces, std::span<const std::uint32_t> tiles, const TileOptions& options, double first) {
        thresholds_.clear();
        left_.clear();
        for (double threshold = first; threshold <= first * kThresholdRange; threshold *= kThresholdStep)
            thresholds_.push_back(threshold);
        for (const TileCounts& counts : try_thresholds(faces, tiles, options, thresholds_))
            left_.push_back(std::min(counts.face_share(), counts.inside_share() / kLeastInside));
    }

    std::vector<double> thresholds_, left_;  // shares left, which fall
};

/// One pass; nothing where all thresholds leave less than the target.
std::optional<TileResult> pass_over(TiledFaces& faces, TileOptions options, double target) {
    const auto held = static_cast<double>(faces.chunk().faces.size());
    options.keep_share = target / held * kLeastShare;
    options.threshold = HUGE_VAL;
    double share = target * kPassMargin / held;
    std::optional<ThresholdSearch> search;
    if (target > 0) search.emplace(faces, options, share);
    if (search && search->is_free(share)) options.keep_share = share;  // every tile gives the same share
    double of_sample = share;
    for (int n = 0; n < kMostAttempts; ++n) {
        if (search) options.threshold = search->at(of_sample);
        TileResult done = simplify_tiles(faces, options);
        const auto left = static_cast<double>(done.left.faces.size());
        if (left >= target) return done;
        share *= kPassMargin;
        of_sample *= share * held / left;
        // A larger least share, too: where collapses are free, no threshold leaves more.
        options.keep_share += target / held * (1 + kMostAbove - kLeastShare) / (kMostAttempts - 1);
    }
    return {};
}

}  // namespace

PassResult simplify_below(Chunk& chunk, const TilePlan& plan, const PassOptions& options) {
    PassResult result;
    TileOptions tiles = options.tiles;
    const auto total = static_cast<double>(chunk.faces.size());
    for (int pass = 0; pass < kLowPasses; ++pass) {
        const auto share_of_left = [&](double share) {
            return std::min(share * total / static_cast<double>(chunk.faces.size()), 1.0);
        };
        tiles.keep_share = share_of_left(options.tiles.keep_share);
        tiles.free_share = share_of_left(options.tiles.free_share);
        const TileGrid grid = grid_of(plan, options, chunk.faces.size(), kMostPasses + pass);
        TiledFaces faces(chunk, {}, grid, tiles.threads);
        TileResult done = simplify_tiles(faces, tiles);
        chunk = std::move(done.left);
        add(result.verdicts, done.verdicts);
        ++result.passes;
    }
    return result;
}

PassResult simplify_in_passes(Chunk& chunk, const TilePlan& plan, const PassOptions& options) {
    PassResult result;
    const auto target = static_cast<double>(options.target_faces);
    if (chunk.faces.size() < std::uint64_t{kFewestTiles} * options.tile_faces) return result;
    for (int pass = 0; pass < kMostPasses; ++pass) {
        const std::size_t held = chunk.faces.size();
        if (static_cast<double>(held) <= target * kWorthPass) break;
        const TileGrid grid = grid_of(plan, options, held, pass);
        TiledFaces faces(chunk, {}, grid, options.tiles.threads);
        TileOptions tiles = options.tiles;
        tiles.faces_in_flight = std::max<std::uint64_t>(held / kPartsInFlight, kFacesInFlight);
        std::optional<TileResult> done = pass_over(faces, tiles, target);
        if (!done) break;
        chunk = std::move(done->left);
        add(result.verdicts, done->verdicts);
        ++result.passes;
        if (static_cast<double>(chunk.faces.size()) > static_cast<double>(held) * (1 - kLeastPassGain)) break;
    }
    return result;
}

}  // namespace regionmesh
