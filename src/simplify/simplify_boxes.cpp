#include "simplify/simplify_boxes.h"

#include <algorithm>
#include <cmath>

#include "base/parallel_in_order.h"
#include "simplify/tile.h"

namespace regionmesh {
namespace {

/// What costs less, in units of scale^4, costs nothing.
constexpr double kFreeLevel = 1e-6;

/// First what costs nothing, where it may go further than the rest.
DecimateResult decimate_tile(Tile& tile, BoxedFaces& faces, std::uint32_t box, const TileOptions& options) {
    tile.take_out(faces, box);
    Mesh& mesh = tile.mesh();
    DecimateOptions own = options.decimate;
    own.refresh = false;
    own.limits = faces.grid().limits(box);
    const std::uint32_t face_count = mesh.face_count();
    const auto decimate_to = [&](double share, double level) {
        own.target_faces = static_cast<std::uint32_t>(std::ceil(share * face_count));
        own.max_cost = level * std::pow(own.scale, 4);
        return mesh.face_count() > own.target_faces ? decimate(mesh, own) : DecimateResult{};
    };
    DecimateResult done;
    if (options.free_share < options.keep_share) done = decimate_to(options.free_share, kFreeLevel);
    const DecimateResult more = decimate_to(options.keep_share, options.cost_level);
    for (int n = 0; n < kVerdictCount; ++n) done.verdicts[n] += more.verdicts[n];
    tile.note_left(faces, box);
    return done;
}

}  // namespace

TileResult decimate_boxes(BoxedFaces& faces, const TileOptions& options) {
    const Chunk& batch = faces.batch();
    TileResult result{.left = {.carried = batch.carried, .vertices = faces.rim_vertices(), .faces = {}, .active = {}}};
    Chunk& left = result.left;
    // Room that nothing is written to costs nothing.
    left.vertices.reserve(batch.vertices.size());
    left.faces.reserve(batch.faces.size());
    for (std::uint32_t local : batch.active) left.active.push_back(faces.rim_number(local));
    std::vector<Tile> tiles(std::max(options.in_flight, 1u));
    std::vector<DecimateResult> done(tiles.size());
    const auto work = [&](std::uint32_t box, std::uint32_t place) {
        done[place] = decimate_tile(tiles[place], faces, box, options);
    };
    const auto finish = [&](std::uint32_t, std::uint32_t place) {
        tiles[place].put_back(left);
        for (int n = 0; n < kVerdictCount; ++n) result.verdicts[n] += done[place].verdicts[n];
    };
    parallel_in_order(faces.grid().box_count(), options.in_flight, options.threads, {work, finish});
    return result;
}

BoxCounts try_boxes(BoxedFaces& faces, std::span<const std::uint32_t> boxes, const TileOptions& options) {
    BoxCounts counts;
    std::vector<Tile> tiles(std::max(options.in_flight, 1u));
    const auto work = [&](std::uint32_t n, std::uint32_t place) {
        decimate_tile(tiles[place], faces, boxes[n], options);
    };
    const auto finish = [&](std::uint32_t n, std::uint32_t place) {
        counts.faces += faces.faces_of(boxes[n]).size();
        counts.left_faces += tiles[place].left_faces();
        counts.inside += tiles[place].inside_count();
        counts.left_inside += tiles[place].left_inside();
    };
    parallel_in_order(static_cast<std::uint32_t>(boxes.size()), options.in_flight, options.threads, {work, finish});
    return counts;
}

}  // namespace regionmesh
