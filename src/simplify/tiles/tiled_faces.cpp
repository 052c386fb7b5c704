#include "simplify/tiles/tiled_faces.h"

#include <algorithm>
#include <atomic>

#include "base/box.h"
#include "base/parallel_for.h"
#include "simplify/tuning.h"

namespace regionmesh {

TiledFaces::TiledFaces(const Chunk& chunk, std::span<const ChunkVertex> carried, const TileGrid& grid,
                       std::uint32_t threads)
    : chunk_(chunk), carried_(carried), grid_(grid) {
    const auto face_count = static_cast<std::uint32_t>(chunk.faces.size());
    place_.assign(chunk.carried + chunk.vertices.size(), kNone);
    for_fixed(chunk, [&](std::uint32_t local) { place_[local] = kLocked; });
    part_faces_ = std::max(kPartFaces, face_count / kMostParts + 1);
    std::vector<Part> parts(face_count / part_faces_ + 1);
    tile_of_face_.resize(face_count);
    parallel_for(static_cast<std::uint32_t>(parts.size()), threads, [&](std::uint32_t n) {
        parts[n].places.assign(grid_.tile_count(), 0);
        for (std::uint32_t f = n * part_faces_; f < part_end(n); ++f) assign(f, parts[n]);
    });
    order_faces(parts, threads);
    number_locked();
}

std::uint32_t TiledFaces::part_end(std::uint32_t part) const {
    return std::min((part + 1) * part_faces_, static_cast<std::uint32_t>(chunk_.faces.size()));
}

void TiledFaces::assign(std::uint32_t f, Part& part) {
    const ChunkFace& face = chunk_.faces[f];
    const auto corner = corners(face);
    const std::uint32_t tile = grid_.tile_at((corner[0].position + corner[1].position + corner[2].position) / 3.0);
    Box box;
    for (const ChunkVertex& v : corner) box.add(v.position);
    if (tile != part.tile) part.tile = tile, part.limits = grid_.limits(tile);
    const bool reaches_out = !is_within(box, part.limits);
    for (std::uint32_t local : face.vertices) mark(local, reaches_out ? kLocked : tile);
    if (reaches_out)
        grid_.for_tiles_at(box, [&](std::uint32_t other) {
            if (other != tile) part.halo.push_back({other, f});
        });
    tile_of_face_[f] = tile;
    ++part.places[tile];
}

/// Parts may meet at a vertex. In any order, it ends as the one tile of its faces, or as locked.
void TiledFaces::mark(std::uint32_t local, std::uint32_t tile) {
    const std::atomic_ref mark(place_[local]);
    std::uint32_t seen = mark.load(std::memory_order_relaxed);
    while (seen != kLocked && seen != tile &&
           !mark.compare_exchange_weak(seen, seen == kNone ? tile : kLocked, std::memory_order_relaxed)) {
    }
}

/// Each part knows where its faces of each tile go: after those of the tiles before, and of the parts before.
void TiledFaces::order_faces(std::vector<Part>& parts, std::uint32_t threads) {
    const std::uint32_t tiles = grid_.tile_count();
    start_.resize(tiles + 1);
    std::uint32_t next = 0;
    for (std::uint32_t tile = 0; tile < tiles; ++tile) {
        start_[tile] = next;
        for (Part& part : parts) next += std::exchange(part.places[tile], next);
    }
    start_[tiles] = next;
    order_.resize(next);
    parallel_for(static_cast<std::uint32_t>(parts.size()), threads, [&](std::uint32_t n) {
        for (std::uint32_t f = n * part_faces_; f < part_end(n); ++f) order_[parts[n].places[tile_of_face_[f]]++] = f;
    });
    tile_of_face_ = {};
    for (const Part& part : parts) halo_.insert(halo_.end(), part.halo.begin(), part.halo.end());
    radix_sort(halo_);
}

void TiledFaces::number_locked() {
    std::uint32_t locked = 0;
    for (std::uint32_t& place : place_) place = place == kLocked ? kLocked | locked++ : kNone;
}

std::span<const KeyedIndex> TiledFaces::halo_of(std::uint32_t tile) const {
    const auto [first, last] = std::equal_range(halo_.begin(), halo_.end(), KeyedIndex{tile, 0},
                                                [](const KeyedIndex& a, const KeyedIndex& b) { return a.key < b.key; });
    return {first, last};
}

std::vector<ChunkVertex> TiledFaces::locked_vertices() const {
    std::vector<ChunkVertex> locked;
    for (std::uint32_t local = chunk_.carried; local < place_.size(); ++local)
        if (is_locked(local)) locked.push_back(vertex(local));
    return locked;
}

}  // namespace regionmesh
