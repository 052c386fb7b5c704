#include "stream/plan.h"

#include <algorithm>
#include <numeric>

#include "base/megabytes.h"
#include "regionmesh/error.h"
#include "simplify/tiles/simplify_tiles.h"
#include "smooth/filters/filter.h"
#include "stream/footprint.h"
#include "stream/tuning.h"

namespace regionmesh {
namespace {

/// Tiles of a chunk: columns along the sweep.
std::uint32_t tile_count(const TilePlan& tiles) {
    std::uint32_t count = 1;
    for (int a = 0; a < 2; ++a) {
        const std::uint32_t cells = std::max(tiles.lattice.size[tiles.sweep.axes[a]], 2u) - 1;
        count *= (cells + tiles.tile_cells - 1) / tiles.tile_cells;
    }
    return count;
}

std::uint64_t samples_of_section(const Lattice& lattice, const Sweep& sweep) {
    return std::uint64_t{lattice.size[sweep.axes[0]]} * lattice.size[sweep.axes[1]];
}

/// Strips of a chunk where memory does not limit them: as many as make a tile, or as asked for without tiles.
std::uint32_t strips_per_chunk(const SourceShape& shape, const TilePlan& tiles, const ReconstructOptions& options) {
    if (!is_decimating(options)) return options.strips_per_chunk;
    const std::uint64_t cells = std::max(shape.lattice.size[shape.axis()], 2u) - 1;
    return std::max(static_cast<std::uint32_t>(std::uint64_t{tiles.chunk_strips} * shape.strip_count / cells), 1u);
}

/// Bytes of each strip in the window of smoothing.
std::vector<std::uint64_t> window_bytes(const std::vector<std::uint64_t>& strip_faces, const SourceShape& shape,
                                        SmoothFilter filter) {
    const double samples = static_cast<double>(samples_of_section(shape.lattice, shape.sweep));
    std::vector<std::uint64_t> bytes;
    for (const std::uint64_t faces : strip_faces)
        bytes.push_back(faces *
                        window_bytes_per_face(filter, static_cast<double>(faces) / samples, kWindowBytesPerFace));
    return bytes;
}

BudgetDemand demand_of(const SourceShape& shape, const Target& target, std::vector<std::uint64_t> strip_faces,
                       std::uint32_t window_strips, const TilePlan& tiles, const ReconstructOptions& options) {
    BudgetDemand demand{.source = shape.name,
                        .reading_bytes = shape.reading_bytes,
                        .strip_faces = std::move(strip_faces),
                        .window_bytes = {},
                        .chunk_strips = strips_per_chunk(shape, tiles, options),
                        .tiles = tile_count(tiles),
                        .tiles_in_flight = kTilesInFlight};
    demand.fewest_chunk_strips = demand.chunk_strips;
    demand.is_decimating = is_decimating(options);
    demand.preserves_volume = options.preserve_volume;
    demand.window_strips = window_strips;
    demand.asked_budget = options.face_budget;
    const bool is_counted = !demand.strip_faces.empty();
    if (!is_counted) demand.strip_faces = guessed_strip_faces(shape.lattice, shape.sweep);
    demand.window_bytes = window_bytes(demand.strip_faces, shape, options.smooth.filter);
    if (!demand.is_decimating) {
        // The size of the mesh is not taken from a guess, which may be far too high.
        demand.target_share = is_counted ? 1 : 0;
        return demand;
    }
    demand.fewest_chunk_strips = std::min(demand.chunk_strips, stream::kFewestStrips);
    demand.target_share = is_counted ? std::min(target.share(), 1.0) : 0;
    const double left = shape.strip_overlap > 0 ? stream::kLeftByTilesOfLongFaces : stream::kLeftByTiles;
    if (const double share = target.share() * kTileMargin; share < 1) demand.tile_share = std::max(share, left);
    return demand;
}

}  // namespace

bool is_decimating(const ReconstructOptions& options) {
    const bool is_reduced = options.reduce && *options.reduce > 0;
    return options.decimate &&
           (options.target_faces || is_reduced || options.promises.max_error < HUGE_VAL || options.free_error > 0);
}

std::vector<std::uint64_t> guessed_strip_faces(const Lattice& lattice, Sweep sweep) {
    const std::uint64_t strips = std::max(lattice.size[sweep.axes[2]], 1u) - 1;
    return std::vector<std::uint64_t>(strips, samples_of_section(lattice, sweep));
}

void require_room_to_read(const SourceShape& shape, const ReconstructOptions& options) {
    // Faces of smaller inputs are counted all the same, so that the refusal says what the model needs, too.
    // Counting takes a third of what reading and meshing take, and has to fit, too.
    constexpr std::uint64_t kCountedAnyway = std::uint64_t{256} << 20, kCountedAlways = std::uint64_t{16} << 20;
    const std::uint64_t counted =
        kProcessBytes + std::clamp(2 * std::min(options.memory, kCountedAnyway), kCountedAlways, kCountedAnyway);
    if (options.face_budget || shape.reading_bytes <= std::max(options.memory, counted)) return;
    throw Error(ErrorCode::kInput, memory_limit_text(options.memory) + ": " + shape.name + " needs at least " +
                                       megabytes(shape.reading_bytes) +
                                       " to be read, and more for the model; raise --memory, or change --sweep");
}

Plan make_plan(const SourceShape& shape, std::optional<FaceCount> counted, std::uint32_t window_strips,
               const ReconstructOptions& options) {
    Plan plan{.target = {options.target_faces, options.reduce, {}},
              .tiles = plan_tiles(shape.lattice, shape.sweep),
              .budget = {},
              .oracle = {},
              .is_decimating = is_decimating(options)};
    std::vector<std::uint64_t> strip_faces;
    if (counted) {
        plan.target.total = counted->face_count;
        plan.oracle = std::move(counted->oracle);
        strip_faces = std::move(counted->strip_faces);
    }
    const BudgetDemand demand =
        demand_of(shape, plan.target, std::move(strip_faces), window_strips, plan.tiles, options);
    plan.budget = plan_budget(options.memory, demand);
    require_budget(plan.budget, demand);
    plan.tiles.chunk_strips = plan.budget.chunk_strips;
    return plan;
}

std::uint64_t least_memory(const SourceShape& shape, const std::vector<std::uint64_t>& strip_faces,
                           std::uint32_t window_strips, const ReconstructOptions& options) {
    Target target{options.target_faces, options.reduce, {}};
    if (!strip_faces.empty()) target.total = std::accumulate(strip_faces.begin(), strip_faces.end(), std::uint64_t{0});
    const TilePlan tiles = plan_tiles(shape.lattice, shape.sweep);
    return plan_budget(0, demand_of(shape, target, strip_faces, window_strips, tiles, options)).least.sum();
}

}  // namespace regionmesh
