#include "simplify/raise_level.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/hash.h"

namespace regionmesh {
namespace {

/// A pass aims at so much more than the goal, and is made where more than so much is to be gained; the last is the one
/// that gains less than so much of the faces.
constexpr double kAbove = 1.02, kWorthIt = 1.05, kLeastGain = 0.02;
constexpr int kMostPasses = 3;

/// A model of fewer boxes is left to the heap. Of the others, this part of all faces is out of the batch at a time.
constexpr std::uint32_t kFewestBoxes = 6, kPartInFlight = 6;

/// One box in so many is tried, at so many levels at most, until what is left is so near to what is wanted.
constexpr std::uint32_t kSampled = 8;
constexpr int kMostTries = 3;
constexpr double kNearEnough = 0.03;
constexpr double kMuchLower = 4;

/// A pass that went below the goal all the same is made again with a lower level and a larger least share; so
/// often at most, and up to so much more than the share.
constexpr int kMostAttempts = 3;
constexpr double kMostAbove = 0.05;

/// The level that is tried first, in units of spacing^4, and what times that of the pass before; from one try to the
/// next it changes by the last factor at most.
constexpr double kFirstLevel = 0.015, kNextLevel = 1.25, kMostStep = 16;

/// Faces left go about as this power of the level, before more is known: as measured. A sample may say otherwise,
/// within bounds.
constexpr double kPower = -0.12, kLeastPower = -0.05, kMostPower = -1;

/// What is not rim goes down to this part of the share that all is to keep: the rim is left to the next pass.
constexpr double kLeastInside = 0.9;

/// No box goes below this part of its share.
constexpr double kLeastShare = 0.75;

/// Walls lie between those of the first stage, and in each pass elsewhere.
BoxGrid grid_of(const TilePlan& plan, const RaiseOptions& options, std::uint64_t faces, int pass) {
    BoxGrid grid{.origin = plan.lattice.origin, .spacing = plan.lattice.spacing, .size = {}, .cells = {}};
    for (int axis = 0; axis < 3; ++axis) grid.size[axis] = plan.lattice.size[axis] - 1;
    const int along = plan.sweep.axes[2];
    grid.extent.high[along] = options.high;
    // Cubes, but no larger than the volume.
    std::array<bool, 3> is_cut{true, true, true};
    double side = 0;
    for (int round = 0; round < 3; ++round) {
        double boxes = std::max(static_cast<double>(faces) / options.box_faces, 1.0), cells = 1;
        int axes = 0;
        for (int axis = 0; axis < 3; ++axis)
            if (is_cut[axis]) cells *= grid.size[axis], ++axes;
        side = axes > 0 ? std::pow(cells / boxes, 1.0 / axes) : 0;
        for (int axis = 0; axis < 3; ++axis) is_cut[axis] = is_cut[axis] && grid.size[axis] > side;
    }
    for (int axis = 0; axis < 3; ++axis) {
        const std::uint32_t step = std::max(axis == along ? plan.run_strips : plan.tile_cells, 1u);
        const auto steps = static_cast<std::uint32_t>(std::max(std::round(side / step), 1.0));
        grid.cells[axis] = is_cut[axis] ? steps * step : std::max(grid.size[axis], 1u);
        if (!is_cut[axis]) continue;
        const std::uint32_t half = steps == 1 ? step / 2 : steps / 2 * step;
        grid.shift[axis] = (step / 2 + pass % 2 * half + pass / 2 * (step / 3)) % grid.cells[axis];
    }
    return grid;
}

/// One of every eight boxes that have faces, which one by chance.
std::vector<std::uint32_t> sample(const BoxedFaces& faces) {
    std::vector<std::uint32_t> full, chosen;
    for (std::uint32_t box = 0; box < faces.grid().box_count(); ++box)
        if (!faces.faces_of(box).empty()) full.push_back(box);
    const std::uint32_t every = std::clamp(static_cast<std::uint32_t>(full.size()) / kSampled, 1u, kSampled);
    for (std::uint32_t n = 0; n + every <= full.size(); n += every)
        chosen.push_back(full[n + static_cast<std::uint32_t>(hash_unit(n, every) * every)]);
    return chosen;
}

/// Finds the level at which a sample keeps a share of its faces, but of the vertices that are not rim not much less.
class LevelSearch {
public:
    LevelSearch(BoxedFaces& faces, const TileOptions& options)
        : faces_(faces), boxes_(sample(faces)), options_(options) {}

    double find(double share, double level) {
        for (int n = 0; n < kMostTries; ++n) {
            const double left = left_at(level);
            goes_free_ =
                n > 0 && left < share && level * kMuchLower < seen_level_ && left < seen_left_ * (1 + kNearEnough);
            level = next(level, left, share);
            if (goes_free_ || std::abs(left / share - 1) < kNearEnough) break;
        }
        return level;
    }

    /// Whether a much lower level left no more, and both too few: what goes costs nothing, and no level will do.
    bool goes_free() const { return goes_free_; }

    /// The level to take after one that has left so much.
    double next(double level, double left, double share) {
        if (seen_level_ > 0 && seen_level_ != level)
            power_ = std::clamp(std::log(left / seen_left_) / std::log(level / seen_level_), kMostPower, kLeastPower);
        seen_level_ = level;
        seen_left_ = left;
        return level * std::clamp(std::pow(share / left, 1 / power_), 1 / kMostStep, kMostStep);
    }

private:
    double left_at(double level) {
        options_.cost_level = level;
        const BoxCounts counts = try_boxes(faces_, boxes_, options_);
        const auto share = [](std::uint64_t left, std::uint64_t of) {
            return (static_cast<double>(left) + 1) / (static_cast<double>(of) + 1);
        };
        return std::min(share(counts.left_faces, counts.faces),
                        share(counts.left_inside, counts.inside) / kLeastInside);
    }

    BoxedFaces& faces_;
    std::vector<std::uint32_t> boxes_;
    TileOptions options_;
    double power_ = kPower, seen_level_ = 0, seen_left_ = 0;
    bool goes_free_ = false;
};

/// One pass: the level found, and what is left then; nothing where all levels go too far.
std::optional<TileResult> raise_once(BoxedFaces& faces, TileOptions options, double goal, double& level) {
    const auto held = static_cast<double>(faces.batch().faces.size());
    options.keep_share = goal / held * kLeastShare;
    LevelSearch search(faces, options);
    double share = goal * kAbove / held;
    if (goal > 0) level = search.find(share, level);
    if (search.goes_free()) options.keep_share = share;  // it may go from one box as well as from another
    for (int n = 0; n < kMostAttempts; ++n) {
        options.cost_level = level;
        TileResult done = decimate_boxes(faces, options);
        const auto left = static_cast<double>(done.left.faces.size());
        if (left >= goal) return done;
        share *= kAbove;
        // Of what costs nothing no level leaves more.
        options.keep_share += goal / held * (1 + kMostAbove - kLeastShare) / (kMostAttempts - 1);
        level = search.next(level, left / held, share);
    }
    return {};
}

}  // namespace

RaiseResult raise_level(Chunk& batch, const TilePlan& plan, const RaiseOptions& options) {
    RaiseResult result;
    const auto goal = static_cast<double>(options.goal_faces);
    if (batch.faces.size() < std::uint64_t{kFewestBoxes} * options.box_faces) return result;
    for (int pass = 0; pass < kMostPasses; ++pass) {
        const std::size_t held = batch.faces.size();
        if (static_cast<double>(held) <= goal * kWorthIt) break;
        const BoxGrid grid = grid_of(plan, options, held, pass);
        BoxedFaces faces(batch, {}, grid, options.tiles.threads);
        TileOptions tiles = options.tiles;
        tiles.in_flight = std::clamp(static_cast<std::uint32_t>(held / options.box_faces / kPartInFlight), 1u,
                                     std::max(tiles.in_flight, 1u));
        double level = goal == 0 ? HUGE_VAL : pass == 0 ? kFirstLevel : result.level * kNextLevel;
        std::optional<TileResult> done = raise_once(faces, tiles, goal, level);
        if (!done) break;
        batch = std::move(done->left);
        for (int n = 0; n < kVerdictCount; ++n) result.verdicts[n] += done->verdicts[n];
        ++result.raises;
        result.level = level;
        if (static_cast<double>(batch.faces.size()) > static_cast<double>(held) * (1 - kLeastGain)) break;
    }
    return result;
}

}  // namespace regionmesh
