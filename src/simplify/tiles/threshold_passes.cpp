#include "simplify/tiles/threshold_passes.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "regionmesh/process.h"
#include "simplify/collapse_edges.h"

namespace regionmesh {
namespace {

/// Side in cells of cubes of which `tiles` fill the grid; along an axis that is shorter than the side there is one
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
TileGrid pass_grid(const TilePlan& plan, const PassOptions& options, std::uint64_t faces, int pass) {
    TileGrid grid = grid_of(plan, {}, {}, options.safe);
    std::array<bool, 3> is_cut;
    const double side = side_of_tiles(grid, std::max(static_cast<double>(faces) / options.tile_faces, 1.0), is_cut);
    for (int axis = 0; axis < 3; ++axis) {
        if (!is_cut[axis]) continue;
        const std::uint32_t step = std::max(axis == plan.sweep.axes[2] ? plan.chunk_strips : plan.tile_cells, 1u);
        const auto steps = static_cast<std::uint32_t>(std::max(std::round(side / step), 1.0));
        grid.cells[axis] = steps * step;
        const std::uint32_t half = steps == 1 ? step / 2 : steps / 2 * step;
        grid.shift[axis] = (step / 2 + pass % 2 * half + pass / 2 * (step / 3)) % grid.cells[axis];
        if (!plan.is_bounded)
            grid.shift[axis] = static_cast<std::uint32_t>(std::fmod(0.618 * pass, 1.0) * grid.cells[axis]);
    }
    return grid;
}

/// What a sample of the tiles of the first pass keeps at each threshold.
class ThresholdSearch {
public:
    /// Shares down to `options.keep_share` can be found, those above `most` are of no interest.
    ThresholdSearch(TiledFaces& faces, const TileOptions& options, double most)
        : held_(static_cast<double>(faces.chunk().faces.size())) {
        const std::vector<std::uint32_t> tiles = sample_of_tiles(faces);
        trial(faces, tiles, options, kFirstThreshold);
        if (first_.front() < most) trial(faces, tiles, options, kFirstThreshold / kThresholdRange);
    }

    /// That of `pass` leaves about so many faces of the mesh. Of the first pass: and not much less of the vertices that
    /// are not locked. Walls of those that follow lie elsewhere: all vertices may become as few.
    double threshold(int pass, double faces) const {
        const std::vector<double>& left = left_by(pass);
        const double share = faces / held_;
        if (is_free(pass, faces)) return thresholds_.front();
        const auto after = std::ranges::find_if(left, [&](double at) { return at < share; });
        if (after == left.end()) return HUGE_VAL;
        // Between thresholds that were tried the share left is a power of the threshold.
        const auto n = after - left.begin();
        const double part = std::log(share / left[n - 1]) / std::log(left[n] / left[n - 1]);
        return thresholds_[n - 1] * std::pow(kThresholdStep, part);
    }

    /// All thresholds leave less: the collapses are free.
    bool is_free(int pass, double faces) const { return left_by(pass).front() < faces / held_; }

private:
    void trial(TiledFaces& faces, std::span<const std::uint32_t> tiles, const TileOptions& options, double first) {
        thresholds_.clear();
        first_.clear();
        inside_.clear();
        for (double threshold = first; threshold <= first * kThresholdRange; threshold *= kThresholdStep)
            thresholds_.push_back(threshold);
        for (const TileCounts& counts : try_thresholds(faces, tiles, options, thresholds_)) {
            inside_.push_back(counts.inside_share());
            first_.push_back(std::min(counts.face_share(), counts.inside_share() / kLeastInside));
        }
    }

    const std::vector<double>& left_by(int pass) const { return pass == 0 ? first_ : inside_; }

    double held_;
    std::vector<double> thresholds_, first_, inside_;  // and the shares left, which fall
};

/// One pass; nothing where all thresholds leave less than the target. The first one sets `search`.
std::optional<TileResult> pass_over(TiledFaces& faces, TileOptions options, double target, int pass,
                                    std::optional<ThresholdSearch>& search) {
    const auto held = static_cast<double>(faces.chunk().faces.size());
    options.keep_share = target / held * kLeastShare;
    options.threshold = HUGE_VAL;
    if (target == 0) return simplify_tiles(faces, options);
    double wanted = target * kPassMargin, aim = wanted;  // what the search is asked for, so that it is left
    if (!search) {
        search.emplace(faces, options, wanted / held);
        give_back_freed_memory();
    }
    const auto take_aim = [&](double share) {
        options.threshold = search->threshold(pass, aim);
        if (search->is_free(pass, aim)) options.keep_share = std::max(options.keep_share, share);  // in every tile
    };
    // Never a higher threshold: what is locked is left to the next pass.
    const auto correct = [&](std::uint64_t of, std::uint64_t left) {
        give_back_freed_memory();
        const double share_left = static_cast<double>(left) / static_cast<double>(of);
        const double share =
            std::max(wanted - static_cast<double>(left), 0.0) / std::max(held - static_cast<double>(of), 1.0);
        if (share > share_left) {
            aim *= share / share_left;
            take_aim(share);
        }
        return options;
    };
    for (int n = 0; n < kMostAttempts; ++n) {
        take_aim(wanted / held);
        TileResult done = simplify_tiles_in_parts(faces, options, correct);
        const auto left = static_cast<double>(done.left.faces.size());
        if (left >= target) return done;
        wanted *= kPassMargin;
        aim *= wanted / left;
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
        const TileGrid grid = pass_grid(plan, options, chunk.faces.size(), kMostPasses + pass);
        TiledFaces faces(chunk, {}, grid, tiles.threads);
        TileResult done = simplify_tiles(faces, tiles);
        chunk = std::move(done.left);
        add(result.verdicts, done.verdicts);
        ++result.passes;
    }
    return result;
}

bool is_worth_pass(std::uint64_t faces, const PassOptions& options) {
    return faces >= std::uint64_t{kFewestTiles} * options.tile_faces &&
           static_cast<double>(faces) > static_cast<double>(options.target_faces) * kWorthPass;
}

PassResult simplify_in_passes(Chunk& chunk, const TilePlan& plan, const PassOptions& options) {
    PassResult result;
    const auto target = static_cast<double>(options.target_faces);
    std::optional<ThresholdSearch> search;
    for (int pass = 0; pass < kMostPasses && is_worth_pass(chunk.faces.size(), options); ++pass) {
        const std::size_t held = chunk.faces.size();
        const TileGrid grid = pass_grid(plan, options, held, pass);
        TiledFaces faces(chunk, {}, grid, options.tiles.threads);
        TileOptions tiles = options.tiles;
        tiles.faces_in_flight = std::max<std::uint64_t>(held / kPartsInFlight, kFacesInFlight);
        std::optional<TileResult> done = pass_over(faces, tiles, target, pass, search);
        if (!done) break;
        chunk = std::move(done->left);
        add(result.verdicts, done->verdicts);
        ++result.passes;
        if (static_cast<double>(chunk.faces.size()) > static_cast<double>(held) * (1 - kLeastPassGain)) break;
    }
    return result;
}

}  // namespace regionmesh
