#include "regionmesh/tile/decimate_boxes.h"

#include <algorithm>
#include <cmath>

#include "regionmesh/base/parallel_in_order.h"
#include "regionmesh/tile/tile.h"

namespace regionmesh {
namespace {

DecimateOptions options_for(const TileOptions& options, std::uint32_t face_count, const Box& limits) {
    DecimateOptions own = options.decimate;
    own.target_faces = static_cast<std::uint32_t>(std::ceil(options.keep_share * face_count));
    own.max_cost = options.cost_level * std::pow(own.scale, 4);
    own.refresh = false;
    own.limits = limits;
    return own;
}

DecimateResult decimate_tile(Tile& tile, BoxedFaces& faces, std::uint32_t box, const TileOptions& options) {
    tile.take_out(faces, box);
    DecimateResult done = tile.decimate(options_for(options, tile.face_count(), faces.grid().limits(box)));
    tile.note_left(faces, box);
    return done;
}

}  // namespace

TileResult decimate_boxes(BoxedFaces& faces, const TileOptions& options) {
    const FaceBatch& batch = faces.batch();
    TileResult result{.left = {.carried = batch.carried, .vertices = faces.rim_vertices(), .faces = {}, .open = {}}};
    FaceBatch& left = result.left;
    // Room that nothing is written to costs nothing.
    left.vertices.reserve(batch.vertices.size());
    left.faces.reserve(batch.faces.size());
    for (std::uint32_t local : batch.open) left.open.push_back(faces.rim_number(local));
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
