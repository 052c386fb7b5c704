#include "regionmesh/tile/tiles.h"

#include <algorithm>
#include <cmath>

#include "regionmesh/base/parallel_for.h"

namespace regionmesh {
namespace {

constexpr std::uint32_t kTileCells = 24;
constexpr std::uint32_t kShortestRun = 8;
constexpr std::uint64_t kSamplesPerRun = 2u << 20;
constexpr std::uint32_t kNone = 0xFFFFFFFFu;
constexpr std::uint32_t kWave = 16;  // tiles out of the batch at a time, whatever the number of threads

bool is_within(const Box& inner, const Box& outer) {
    for (int axis = 0; axis < 3; ++axis)
        if (inner.low[axis] < outer.low[axis] || inner.high[axis] > outer.high[axis]) return false;
    return true;
}

/// A tile taken out of the batch.
struct Tile {
    Model model;
    std::vector<std::uint32_t> locals;  // batch numbers of its vertices
    std::vector<VertexId> sorted;       // where those went when the model was sorted
    DecimateResult done;
};

/// A run's batch while its tiles are taken out, decimated and put back.
class RunTiles {
public:
    RunTiles(FaceBatch& batch, std::span<const BatchVertex> carried, RunExtent extent, const TilePlan& plan,
             const TileOptions& options)
        : batch_(batch), carried_(carried), extent_(extent), plan_(plan), options_(options) {
        for (int a = 0; a < 2; ++a) tile_count_[a] = (cells(a) + plan.tile_cells - 1) / plan.tile_cells;
    }

    TileResult run() {
        sort_faces_by_tile();
        find_rim();
        radix_sort(obstacles_);
        made_.carried = batch_.carried;
        // Taken out and put back one after the other, since they share the rim; decimated at the same time.
        std::vector<Tile> tiles(kWave);
        for (std::uint32_t first = 0; first + 1 < tile_start_.size(); first += kWave) {
            const auto count =
                std::min<std::uint32_t>(kWave, static_cast<std::uint32_t>(tile_start_.size()) - 1 - first);
            for (std::uint32_t n = 0; n < count; ++n) tiles[n] = take_out(first + n);
            parallel_for(count, options_.threads, [&](std::uint32_t n) { decimate_tile(first + n, tiles[n]); });
            for (std::uint32_t n = 0; n < count; ++n) put_back(tiles[n]);
        }
        for (const BatchFace& face : batch_.faces) {
            if (!is_rim_face(face)) continue;
            const auto& v = face.vertices;
            made_.faces.push_back({{made_number(v[0]), made_number(v[1]), made_number(v[2])}, face.labels});
        }
        for (std::uint32_t local : batch_.open) made_.open.push_back(made_number(local));
        batch_ = std::move(made_);
        return result_;
    }

private:
    static constexpr std::uint32_t kInside = 0, kRim = 1;

    std::uint32_t cells(int a) const { return plan_.lattice.size[plan_.sweep.axes[a]] - 1; }
    const BatchVertex& vertex(std::uint32_t local) const {
        return local < batch_.carried ? carried_[local] : batch_.vertices[local - batch_.carried];
    }
    std::uint32_t vertex_end() const { return batch_.carried + static_cast<std::uint32_t>(batch_.vertices.size()); }

    /// The tile of the cell that a face lies in; on the far sides of the box, of the cell before.
    std::uint32_t tile_of(const BatchFace& face) const {
        const Vec3 middle = (vertex(face.vertices[0]).position + vertex(face.vertices[1]).position +
                             vertex(face.vertices[2]).position) /
                            3.0;
        std::uint32_t tile = 0;
        for (int a = 1; a >= 0; --a) {
            const int axis = plan_.sweep.axes[a];
            const double cell = std::floor((middle[axis] - plan_.lattice.origin[axis]) / plan_.lattice.spacing[axis]);
            const auto clamped = static_cast<std::uint32_t>(std::clamp(cell, 0.0, cells(a) - 1.0));
            tile = tile * tile_count_[a] + clamped / plan_.tile_cells;
        }
        return tile;
    }

    void sort_faces_by_tile() {
        std::vector<std::uint32_t> tile_of_face;
        tile_of_face.reserve(batch_.faces.size());
        tile_start_.assign(std::size_t{tile_count_[0]} * tile_count_[1] + 1, 0);
        for (const BatchFace& face : batch_.faces) {
            tile_of_face.push_back(tile_of(face));
            ++tile_start_[tile_of_face.back() + 1];
        }
        for (std::size_t t = 1; t < tile_start_.size(); ++t) tile_start_[t] += tile_start_[t - 1];
        std::vector<std::uint32_t> next(tile_start_.begin(), tile_start_.end() - 1);
        order_.resize(batch_.faces.size());
        for (std::uint32_t f = 0; f < tile_of_face.size(); ++f) order_[next[tile_of_face[f]]++] = f;
    }

    Box box_of(const BatchFace& face) const {
        Box box;
        for (std::uint32_t local : face.vertices) box.add(vertex(local).position);
        return box;
    }
    bool is_rim_face(const BatchFace& face) const {
        return std::all_of(face.vertices.begin(), face.vertices.end(),
                           [&](std::uint32_t local) { return rim_[local] == kRim; });
    }

    /// Marks vertices that are carried, open, or in more than one tile, and those of faces that reach out of their box.
    void find_rim() {
        rim_.assign(vertex_end(), kInside);
        std::fill(rim_.begin(), rim_.begin() + batch_.carried, kRim);
        for (std::uint32_t local : batch_.open) rim_[local] = kRim;
        std::vector<std::uint32_t> seen_in(vertex_end(), kNone);
        for (std::uint32_t tile = 0; tile + 1 < tile_start_.size(); ++tile) {
            const Box limits = limits_of(tile);
            for (std::uint32_t n = tile_start_[tile]; n < tile_start_[tile + 1]; ++n) {
                const BatchFace& face = batch_.faces[order_[n]];
                const bool reaches_out = !is_within(box_of(face), limits);
                for (std::uint32_t local : face.vertices) {
                    if (reaches_out || (seen_in[local] != kNone && seen_in[local] != tile)) rim_[local] = kRim;
                    seen_in[local] = tile;
                }
                if (reaches_out) note_obstacle(order_[n], tile);
            }
        }
        in_tile_.assign(vertex_end(), kNone);
        made_numbers_.assign(vertex_end(), kNone);
        for (std::uint32_t local = 0; local < batch_.carried; ++local) made_numbers_[local] = local;
    }

    /// A face that reaches out of its tile stays as it is, and stands in the way of the tiles that it reaches into.
    void note_obstacle(std::uint32_t f, std::uint32_t own_tile) {
        const Box box = box_of(batch_.faces[f]);
        std::uint32_t first[2], last[2];
        for (int a = 0; a < 2; ++a) {
            const auto tile_at = [&](double x) {
                const int axis = plan_.sweep.axes[a];
                const double cell = (x - plan_.lattice.origin[axis]) / plan_.lattice.spacing[axis];
                return static_cast<std::uint32_t>(std::clamp(cell / plan_.tile_cells, 0.0, tile_count_[a] - 1.0));
            };
            first[a] = tile_at(box.low[plan_.sweep.axes[a]]);
            last[a] = tile_at(box.high[plan_.sweep.axes[a]]);
        }
        for (std::uint32_t y = first[1]; y <= last[1]; ++y)
            for (std::uint32_t x = first[0]; x <= last[0]; ++x)
                if (const std::uint32_t tile = y * tile_count_[0] + x; tile != own_tile)
                    obstacles_.push_back({tile, f});
    }

    Box limits_of(std::uint32_t tile) const {
        const std::uint32_t place[2] = {tile % tile_count_[0], tile / tile_count_[0]};
        Box box;
        for (int a = 0; a < 2; ++a) {
            const int axis = plan_.sweep.axes[a];
            const std::uint32_t first = place[a] * plan_.tile_cells;
            const std::uint32_t last = std::min(first + plan_.tile_cells, cells(a));
            box.low[axis] = plan_.lattice.origin[axis] + first * plan_.lattice.spacing[axis];
            box.high[axis] = plan_.lattice.origin[axis] + last * plan_.lattice.spacing[axis];
        }
        box.low[plan_.sweep.axes[2]] = extent_.low;
        box.high[plan_.sweep.axes[2]] = extent_.high;
        return box;
    }

    Tile take_out(std::uint32_t tile) {
        Tile taken;
        for (std::uint32_t n = tile_start_[tile]; n < tile_start_[tile + 1]; ++n) put_in(taken, order_[n]);
        const auto is_before = [](const KeyedIndex& a, std::uint32_t key) { return a.key < key; };
        for (auto at = std::lower_bound(obstacles_.begin(), obstacles_.end(), tile, is_before);
             at != obstacles_.end() && at->key == tile; ++at)
            put_in(taken, at->index);
        for (std::uint32_t local : taken.locals) in_tile_[local] = kNone;
        return taken;
    }

    void put_in(Tile& taken, std::uint32_t f) {
        const BatchFace& face = batch_.faces[f];
        std::array<VertexId, 3> corner;
        for (int c = 0; c < 3; ++c) {
            const std::uint32_t local = face.vertices[c];
            if (in_tile_[local] == kNone) {
                const bool is_rim = rim_[local] == kRim;
                in_tile_[local] = index(taken.model.add_vertex(vertex(local).position, vertex(local).sides, is_rim));
                taken.locals.push_back(local);
            }
            corner[c] = VertexId{in_tile_[local]};
        }
        taken.model.add_face(corner[0], corner[1], corner[2], face.labels[0], face.labels[1]);
    }

    void decimate_tile(std::uint32_t tile, Tile& taken) const {
        Model& model = taken.model;
        taken.sorted = model.sort_spatially();
        DecimateOptions own = options_.decimate;
        own.target_faces = static_cast<std::uint32_t>(std::ceil(options_.keep_share * model.face_count()));
        own.max_cost = options_.cost_level * std::pow(own.scale, 4);
        own.refresh = false;
        own.limits = limits_of(tile);
        taken.done = decimate(model, own);
    }

    /// Appends what is left of a tile. Its rim is shared: numbered once for all tiles. Faces all of rim vertices have
    /// not changed, and may be in several tiles: they are put back from the batch.
    void put_back(const Tile& taken) {
        const Model& model = taken.model;
        for (int n = 0; n < kVerdictCount; ++n) result_.verdicts[n] += taken.done.verdicts[n];
        std::vector<std::uint32_t> number(model.vertex_end(), kNone);
        for (std::uint32_t n = 0; n < taken.locals.size(); ++n)
            if (rim_[taken.locals[n]] == kRim) number[index(taken.sorted[n])] = made_number(taken.locals[n]);
        for (std::uint32_t f = 0; f < model.face_end(); ++f) {
            if (!model.is_alive(FaceId{f})) continue;
            BatchFace face{{}, model[FaceId{f}].labels};
            const auto& corners = model[FaceId{f}].vertices;
            if (std::all_of(corners.begin(), corners.end(), [&](VertexId v) { return model[v].is_fixed; })) continue;
            for (int c = 0; c < 3; ++c) {
                const VertexId v = corners[c];
                if (number[index(v)] == kNone) number[index(v)] = add_vertex({model[v].position, model[v].sides});
                face.vertices[c] = number[index(v)];
            }
            made_.faces.push_back(face);
        }
    }

    std::uint32_t add_vertex(const BatchVertex& made) {
        made_.vertices.push_back(made);
        return made_.carried + static_cast<std::uint32_t>(made_.vertices.size()) - 1;
    }
    /// Number of a rim vertex in the batch that is made.
    std::uint32_t made_number(std::uint32_t local) {
        if (made_numbers_[local] == kNone) made_numbers_[local] = add_vertex(vertex(local));
        return made_numbers_[local];
    }

    FaceBatch& batch_;
    std::span<const BatchVertex> carried_;
    RunExtent extent_;
    const TilePlan& plan_;
    const TileOptions& options_;
    std::uint32_t tile_count_[2];
    std::vector<std::uint32_t> tile_start_, order_;  // faces by tile
    std::vector<KeyedIndex> obstacles_;              // tile and face
    std::vector<std::uint8_t> rim_;
    std::vector<std::uint32_t> in_tile_;       // batch number to tile vertex, for the tile in hand
    std::vector<std::uint32_t> made_numbers_;  // batch number to made number, for carried and rim vertices
    FaceBatch made_;
    TileResult result_;
};

}  // namespace

TilePlan plan_tiles(const Lattice& lattice, Sweep sweep) {
    const std::uint64_t section = std::uint64_t{lattice.size[sweep.axes[0]]} * lattice.size[sweep.axes[1]];
    const auto strips =
        static_cast<std::uint32_t>(std::clamp<std::uint64_t>(kSamplesPerRun / section, kShortestRun, kTileCells));
    return {lattice, sweep, strips, kTileCells};
}

TileResult decimate_tiles(FaceBatch& batch, std::span<const BatchVertex> carried, RunExtent extent,
                          const TilePlan& plan, const TileOptions& options) {
    return RunTiles(batch, carried, extent, plan, options).run();
}

}  // namespace regionmesh
