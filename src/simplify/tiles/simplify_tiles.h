// Simplifies a chunk of faces tile by tile, on all threads.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "regionmesh/limits.h"
#include "regionmesh/simplify.h"
#include "simplify/tiles/tiled_faces.h"
#include "simplify/tuning.h"
#include "surface/chunk.h"

namespace regionmesh {

struct TileOptions {
    double threshold;                            // in units of scale^4: collapses up to this cost
    double keep_share;                           // tiles stop at this share of their faces,
    double free_share = 1;                       // and free collapses at this one where it is less
    std::uint32_t threads = 1;                   // tiles at work at a time; 0: one per core. The result is the same
    std::uint32_t in_flight = kTilesInFlight;    // tiles out of the chunk at a time; the result is the same
    std::uint64_t faces_in_flight = kMostFaces;  // their faces, but one tile at least; the result is the same
    SimplifyOptions simplify;                    // quality, error, perturbation, scale, placement, tests
    std::function<void(double)> on_share = {};   // share of the tiles that are done: one call at a time, on any thread
};

struct TileResult {
    Chunk left;
    VerdictCounts verdicts{};
};

/// Simplifies each tile alone with its locked vertices fixed; merged vertices stay strictly inside their tile, so that
/// the changes of two tiles cannot meet. Active vertices stay active, in their order.
TileResult simplify_tiles(TiledFaces& faces, const TileOptions& options);

/// The same in two parts: first about one tile in kFirstTiles, drawn by a hash; then the others with the options that
/// `next` makes of what the first held and what they have left.
TileResult simplify_tiles_in_parts(TiledFaces& faces, const TileOptions& options,
                                   const std::function<TileOptions(std::uint64_t held, std::uint64_t left)>& next);

/// How many of the tiles may be out of the chunk at a time: any so many that follow each other have at most
/// `faces_in_flight` faces with their halos. From 1 to `in_flight`.
std::uint32_t tiles_in_flight(const TiledFaces& faces, std::span<const std::uint32_t> tiles,
                              const TileOptions& options);

/// One of every kSampledTiles tiles that have faces, drawn by a hash; of fewer where there are few, but not fewer than
/// `least_every`; of more where the sample would have more than about kMostSampledTiles.
std::vector<std::uint32_t> sample_of_tiles(const TiledFaces& faces, std::uint32_t least_every = 1);

/// Size of a sample of tiles, before and after.
struct TileCounts {
    std::uint64_t faces = 0, left_faces = 0;    // their own
    std::uint64_t inside = 0, left_inside = 0;  // vertices that are not locked

    /// The shares that are left; 1 of nothing.
    double face_share() const { return share(left_faces, faces); }
    double inside_share() const { return share(left_inside, inside); }

private:
    static double share(std::uint64_t left, std::uint64_t of) {
        return (static_cast<double>(left) + 1) / (static_cast<double>(of) + 1);
    }
};

/// Simplifies some tiles up to the last of some thresholds, which rise; returns what was left at each, and leaves the
/// tiles as they were. A tile ends at `keep_share`.
std::vector<TileCounts> try_thresholds(TiledFaces& faces, std::span<const std::uint32_t> tiles,
                                       const TileOptions& options, std::span<const double> thresholds);

}  // namespace regionmesh
