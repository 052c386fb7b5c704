#include "simplify/tiles/simplify_tiles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "base/hash.h"
#include "base/parallel_in_order.h"
#include "simplify/collapse_edges.h"
#include "simplify/tiles/tile.h"

namespace regionmesh {
namespace {

/// Collapses the edges of a tile that is taken out, up to a threshold.
VerdictCounts collapse_up_to(double threshold, Mesh& mesh, const CollapseBounds& bounds, std::uint32_t target_faces,
                             const TileOptions& options) {
    SimplifyOptions own = options.simplify;
    own.on_progress = {};
    own.target_faces = target_faces;
    own.max_cost = std::min(options.simplify.max_cost, threshold * std::pow(own.promises.scale, 4));
    return collapse_edges(mesh, own, bounds).verdicts;
}

/// First what is free, where that may go further than the rest.
VerdictCounts simplify_tile(Tile& tile, TiledFaces& faces, std::uint32_t number, const TileOptions& options) {
    tile.take_out(faces, number);
    const CollapseBounds bounds{.limits = faces.grid().limits(number), .refresh = false};
    const std::uint32_t face_count = tile.mesh().face_count();
    const auto faces_at = [&](double share) { return static_cast<std::uint32_t>(std::ceil(share * face_count)); };
    VerdictCounts verdicts{};
    if (options.free_share < options.keep_share)
        verdicts = collapse_up_to(kFreeCost, tile.mesh(), bounds, faces_at(options.free_share), options);
    add(verdicts, collapse_up_to(options.threshold, tile.mesh(), bounds, faces_at(options.keep_share), options));
    tile.note_left(faces, number);
    return verdicts;
}

/// What a tile has left at each of the thresholds.
std::vector<TileCounts> counts_at(std::span<const double> thresholds, Tile& tile, TiledFaces& faces,
                                  std::uint32_t number, const TileOptions& options) {
    tile.take_out(faces, number);
    const Mesh& mesh = tile.mesh();
    const std::uint64_t own_faces = faces.faces_of(number).size(), inside = tile.inside_count();
    CostHistogram histogram;
    for (const double threshold : thresholds)
        histogram.costs.push_back(threshold * std::pow(options.simplify.promises.scale, 4));
    collapse_up_to(thresholds.back(), tile.mesh(),
                   {.limits = faces.grid().limits(number), .refresh = false, .histogram = &histogram},
                   static_cast<std::uint32_t>(std::ceil(options.keep_share * mesh.face_count())), options);
    histogram.removed.resize(thresholds.size());
    TileCounts left{own_faces, own_faces, inside, inside};
    std::vector<TileCounts> counts;
    for (const auto& [removed_faces, removed_vertices] : histogram.removed) {
        left.left_faces -= removed_faces;
        left.left_inside -= removed_vertices;
        counts.push_back(left);
    }
    tile.note_left(faces, number);
    return counts;
}

/// The vertices that no tile changes.
TileResult nothing_left_of(const TiledFaces& faces) {
    const Chunk& chunk = faces.chunk();
    TileResult result{.left = {.carried = chunk.carried,
                               .vertices = faces.locked_vertices(),
                               .faces = {},
                               .active = {},
                               .carried_bounds = {}}};
    // Reserved pages that are never written cost no memory.
    result.left.vertices.reserve(chunk.vertices.size());
    result.left.faces.reserve(chunk.faces.size());
    for (std::uint32_t local : chunk.active) result.left.active.push_back(faces.locked_number(local));
    return result;
}

void simplify_some(TiledFaces& faces, std::span<const std::uint32_t> numbers, const TileOptions& options,
                   TileResult& result) {
    const std::uint32_t in_flight = tiles_in_flight(faces, numbers, options);
    std::vector<Tile> tiles(in_flight);
    std::vector<VerdictCounts> verdicts(in_flight);
    const auto work = [&](std::uint32_t n, std::uint32_t place) {
        verdicts[place] = simplify_tile(tiles[place], faces, numbers[n], options);
    };
    const auto finish = [&](std::uint32_t n, std::uint32_t place) {
        tiles[place].put_back(result.left);
        add(result.verdicts, verdicts[place]);
        if (options.on_share) options.on_share((n + 1.0) / static_cast<double>(numbers.size()));
    };
    parallel_in_order(static_cast<std::uint32_t>(numbers.size()), in_flight, options.threads, {work, finish});
}

/// Options for the tiles whose work is this part of all.
TileOptions between(double from, double to, TileOptions options) {
    if (options.on_share)
        options.on_share = [from, to, all = std::move(options.on_share)](double done) {
            all(std::lerp(from, to, done));
        };
    return options;
}

}  // namespace

std::uint32_t tiles_in_flight(const TiledFaces& faces, std::span<const std::uint32_t> tiles,
                              const TileOptions& options) {
    const auto size_of = [&](std::size_t n) {
        return faces.faces_of(tiles[n]).size() + faces.halo_of(tiles[n]).size();
    };
    std::size_t most = std::max(options.in_flight, 1u), first = 0;
    std::uint64_t sum = 0;  // of the tiles from `first` to `n`
    for (std::size_t n = 0; n < tiles.size(); ++n) {
        for (sum += size_of(n); sum > options.faces_in_flight && first < n; ++first) {
            most = std::min(most, n - first);
            sum -= size_of(first);
        }
    }
    return static_cast<std::uint32_t>(std::max<std::size_t>(most, 1));
}

std::vector<std::uint32_t> sample_of_tiles(const TiledFaces& faces, std::uint32_t least_every) {
    std::vector<std::uint32_t> full, chosen;
    for (std::uint32_t tile = 0; tile < faces.grid().tile_count(); ++tile)
        if (!faces.faces_of(tile).empty()) full.push_back(tile);
    const auto count = static_cast<std::uint32_t>(full.size());
    const std::uint32_t one_in = std::clamp(count / kSampledTiles, least_every, kSampledTiles);
    const std::uint32_t every = std::min(std::max(one_in, count / kMostSampledTiles), std::max(count, 1u));
    for (std::uint32_t n = 0; n + every <= full.size(); n += every)
        chosen.push_back(full[n + static_cast<std::uint32_t>(hash_unit(n, every) * every)]);
    return chosen;
}

TileResult simplify_tiles(TiledFaces& faces, const TileOptions& options) {
    TileResult result = nothing_left_of(faces);
    std::vector<std::uint32_t> all(faces.grid().tile_count());
    std::iota(all.begin(), all.end(), 0);
    simplify_some(faces, all, options, result);
    return result;
}

TileResult simplify_tiles_in_parts(TiledFaces& faces, const TileOptions& options,
                                   const std::function<TileOptions(std::uint64_t, std::uint64_t)>& next) {
    TileResult result = nothing_left_of(faces);
    std::array<std::vector<std::uint32_t>, 2> parts;
    std::uint64_t held = 0;
    for (std::uint32_t n = 0; n < faces.grid().tile_count(); ++n) {
        const bool is_first = hash_unit(n, kFirstTiles) * kFirstTiles < 1;
        parts[is_first ? 0 : 1].push_back(n);
        if (is_first) held += faces.faces_of(n).size();
    }
    const double end = static_cast<double>(parts[0].size()) / faces.grid().tile_count();
    simplify_some(faces, parts[0], between(0, end, options), result);
    simplify_some(faces, parts[1], between(end, 1, held > 0 ? next(held, result.left.faces.size()) : options), result);
    return result;
}

std::vector<TileCounts> try_thresholds(TiledFaces& faces, std::span<const std::uint32_t> numbers,
                                       const TileOptions& options, std::span<const double> thresholds) {
    std::vector<TileCounts> sums(thresholds.size());
    const std::uint32_t in_flight = tiles_in_flight(faces, numbers, options);
    std::vector<Tile> tiles(in_flight);
    std::vector<std::vector<TileCounts>> counts(in_flight);
    const auto work = [&](std::uint32_t n, std::uint32_t place) {
        counts[place] = counts_at(thresholds, tiles[place], faces, numbers[n], options);
    };
    const auto finish = [&](std::uint32_t, std::uint32_t place) {
        for (std::size_t n = 0; n < sums.size(); ++n) {
            sums[n].faces += counts[place][n].faces;
            sums[n].left_faces += counts[place][n].left_faces;
            sums[n].inside += counts[place][n].inside;
            sums[n].left_inside += counts[place][n].left_inside;
        }
    };
    parallel_in_order(static_cast<std::uint32_t>(numbers.size()), in_flight, options.threads, {work, finish});
    return sums;
}

}  // namespace regionmesh
