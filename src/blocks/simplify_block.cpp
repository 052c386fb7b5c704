#include "blocks/simplify_block.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "regionmesh/limits.h"
#include "simplify/collapse_edges.h"
#include "simplify/decimate.h"
#include "simplify/tiles/mesh_chunk.h"
#include "simplify/tiles/simplify_tiles.h"

namespace regionmesh {
namespace {

/// Thresholds of trials begin at this cost, and each is larger by this factor.
constexpr double kFirstTrial = 1e-3, kTrialStep = 4;
/// They end at this multiple of the least share: tiles stop at that share themselves.
constexpr double kNearLeast = 1.1;
/// Faces of a tile of trials; one tile in kSampledTiles is tried. AAL in blocks of 109 has 46 thousand faces in a
/// block: trials of all tiles of kTileFaces took 1.0 of 8.4 s, these take 0.2 s.
constexpr std::uint32_t kTrialFaces = 4096;

TilePlan plan_of(const BlockChunk& block) {
    Lattice lattice = block.lattice;
    for (int axis = 0; axis < 3; ++axis) lattice.size[axis] = block.cells.size()[axis] + 1;
    return {.lattice = lattice,
            .sweep = block.sweep,
            .chunk_strips = kTileCells,
            .tile_cells = kTileCells,
            .first_cell = block.cells.low};
}

TileOptions tile_options(const BlockSimplifyOptions& options) {
    return {.threshold = kTileThreshold, .keep_share = 0, .threads = options.threads, .simplify = options.simplify};
}

/// Side in cells of tiles with about `faces` faces.
std::uint32_t side_of_tiles(const BlockChunk& block, std::uint32_t faces) {
    const auto size = block.cells.size();
    const double cells = static_cast<double>(size[0]) * size[1] * size[2];
    const double tiles = std::max(static_cast<double>(block.chunk.faces.size()) / faces, 1.0);
    return static_cast<std::uint32_t>(std::max(std::ceil(std::cbrt(cells / tiles)), 8.0));
}

Box limits_of(const BlockChunk& block) { return grid_of(plan_of(block), {}).limits(0); }

/// Tiles of `side` cells; the walls of the outermost are those of the block.
TileGrid cubes(const BlockChunk& block, std::uint32_t side, std::uint32_t shift) {
    return grid_of(plan_of(block), {side, side, side}, {shift, shift, shift});
}

/// Tiles with about `faces` faces, whose walls lie half a tile from those of the block.
TileGrid threshold_grid(const BlockChunk& block, std::uint32_t faces) {
    const std::uint32_t side = side_of_tiles(block, faces);
    return cubes(block, side, side / 2);
}

/// The block as one mesh, with one heap.
void collapse_whole(BlockChunk& block, const SimplifyOptions& options) {
    Mesh mesh = sorted_mesh_of(std::exchange(block.chunk, {}));
    collapse_edges(mesh, options, {.limits = limits_of(block), .refresh = false});
    block.chunk = take_chunk(mesh);
}

SimplifyOptions up_to(double threshold, const BlockSimplifyOptions& options) {
    SimplifyOptions own = options.simplify;
    own.max_cost = std::min(own.max_cost, threshold * std::pow(own.promises.scale, 4));
    return own;
}

}  // namespace

void simplify_low(BlockChunk& block, double share, const BlockSimplifyOptions& options) {
    if (share * kFreeMargin >= 1) return;
    const TileGrid grid = cubes(block, kTileCells, 0);
    TiledFaces faces(block.chunk, {}, grid, options.threads);
    TileResult result = simplify_tiles(faces, first_stage(options.simplify, share, options.threads));
    block.chunk = std::move(result.left);
}

double trial_threshold(int n) { return kFirstTrial * std::pow(kTrialStep, n); }

std::array<double, kMostThresholdTrials> try_thresholds(const BlockChunk& block, double least,
                                                        const BlockSimplifyOptions& options) {
    TileOptions tiles = tile_options(options);
    const TileGrid grid = threshold_grid(block, kTrialFaces);
    TiledFaces faces(block.chunk, {}, grid, options.threads);
    std::array<double, kMostThresholdTrials> left{};
    const std::vector<std::uint32_t> chosen = sample_of_tiles(faces, kSampledTiles);
    if (chosen.empty()) return left;
    std::array<double, kMostThresholdTrials> thresholds;
    for (int n = 0; n < kMostThresholdTrials; ++n) thresholds[n] = trial_threshold(n);
    tiles.keep_share = least;
    const std::vector<TileCounts> counts = regionmesh::try_thresholds(faces, chosen, tiles, thresholds);
    for (int n = 0; n < kMostThresholdTrials; ++n) {
        // Locked vertices of tiles keep their resolution here, and not in the passes to come.
        left[n] = std::min(counts[n].face_share(), counts[n].inside_share());
        if (left[n] < kNearLeast * least) break;
    }
    return left;
}

void simplify_up_to(BlockChunk& block, double threshold, std::uint64_t least, const BlockSimplifyOptions& options) {
    const std::uint64_t goal = least + block.other_faces, held = block.chunk.faces.size();
    if (held <= goal) return;
    if (held < std::uint64_t{kFewestTiles} * kTileFaces) {
        SimplifyOptions own = up_to(threshold, options);
        own.target_faces = static_cast<std::uint32_t>(goal);
        collapse_whole(block, own);
        return;
    }
    const TileGrid grid = threshold_grid(block, kTileFaces);
    TiledFaces faces(block.chunk, {}, grid, options.threads);
    TileOptions tiles = tile_options(options);
    const double share = static_cast<double>(goal) / static_cast<double>(held);
    for (int n = 1; n <= kMostAttempts; ++n) {  // lower each time; the last keeps the share in every tile
        tiles.threshold = threshold * std::pow(kTrialStep, 1 - n);
        tiles.keep_share = n < kMostAttempts ? share * kLeastShare : share;
        TileResult result = simplify_tiles(faces, tiles);
        if (result.left.faces.size() < goal) continue;
        block.chunk = std::move(result.left);
        return;
    }
}

StopReason simplify_and_log(BlockChunk& block, double threshold, const BlockSimplifyOptions& options) {
    std::vector<VertexId> ids;
    Mesh mesh = sorted_mesh_of(block.chunk, 1, &ids);
    CollapseLog log;
    const bool is_last = threshold == HUGE_VAL;
    const CollapseResult done =
        collapse_edges(mesh, up_to(threshold, options), {.limits = limits_of(block), .refresh = is_last, .log = &log});
    std::vector<std::uint32_t> numbers(mesh.vertex_end());
    for (std::uint32_t v = 0; v < ids.size(); ++v) {
        numbers[index(ids[v])] = v;
        if (mesh.is_alive(ids[v])) block.chunk.vertices[v].error_bound = mesh[ids[v]].error_bound();
    }
    block.log = std::move(log.collapses);
    for (LoggedCollapse& collapse : block.log) {
        collapse.goes = numbers[collapse.goes];
        collapse.stays = numbers[collapse.stays];
    }
    return is_last ? done.stopped : StopReason::kTarget;
}

StopReason simplify_to(BlockChunk& block, std::uint64_t target, const BlockSimplifyOptions& options) {
    const std::uint64_t goal = target + block.other_faces;
    if (block.chunk.faces.size() <= goal) return StopReason::kTarget;
    SimplifyOptions own = options.simplify;
    own.target_faces = static_cast<std::uint32_t>(std::min(goal, kMostFaces));
    own.threads = options.threads;
    DecimateResult done;
    Mesh mesh = decimate(
        std::exchange(block.chunk, {}),
        {.tiles = plan_of(block), .margin = target == 0 ? 0.0 : 1.0, .last = {.limits = limits_of(block)}}, own, done);
    block.chunk = take_chunk(mesh);
    return done.stopped;
}

}  // namespace regionmesh
