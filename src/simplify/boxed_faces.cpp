#include "simplify/boxed_faces.h"

#include <algorithm>
#include <atomic>

#include "base/parallel_for.h"

namespace regionmesh {
namespace {

/// Chunks are at least so large, and at most so many: each counts its faces box by box.
constexpr std::uint32_t kChunkFaces = 1u << 15, kMostChunks = 64;

bool is_within(const Box& inner, const Box& outer) {
    return max(inner.low, outer.low) == inner.low && min(inner.high, outer.high) == inner.high;
}

}  // namespace

BoxedFaces::BoxedFaces(const Chunk& batch, std::span<const ChunkVertex> carried, const BoxGrid& grid,
                       std::uint32_t threads)
    : batch_(batch), carried_(carried), grid_(grid) {
    const auto face_count = static_cast<std::uint32_t>(batch.faces.size());
    place_.assign(batch.carried + batch.vertices.size(), kNone);
    std::fill(place_.begin(), place_.begin() + batch.carried, kRim);
    for (std::uint32_t local : batch.active) place_[local] = kRim;
    for (std::uint32_t n = 0; n < batch.vertices.size(); ++n)
        if (batch.vertices[n].sides & kPinned) place_[batch.carried + n] = kRim;
    part_faces_ = std::max(kChunkFaces, face_count / kMostChunks + 1);
    std::vector<Part> parts(face_count / part_faces_ + 1);
    box_of_face_.resize(face_count);
    parallel_for(static_cast<std::uint32_t>(parts.size()), threads, [&](std::uint32_t n) {
        parts[n].places.assign(grid_.box_count(), 0);
        for (std::uint32_t f = n * part_faces_; f < part_end(n); ++f) look_at(f, parts[n]);
    });
    order_faces(parts, threads);
    number_rim();
}

std::uint32_t BoxedFaces::part_end(std::uint32_t part) const {
    return std::min((part + 1) * part_faces_, static_cast<std::uint32_t>(batch_.faces.size()));
}

void BoxedFaces::look_at(std::uint32_t f, Part& part) {
    const ChunkFace& face = batch_.faces[f];
    const auto corner = corners(face);
    const std::uint32_t box = grid_.box_at((corner[0].position + corner[1].position + corner[2].position) / 3.0);
    Box reach;
    for (const ChunkVertex& v : corner) reach.add(v.position);
    const bool reaches_out = !is_within(reach, grid_.limits(box));
    for (std::uint32_t local : face.vertices) mark(local, reaches_out ? kRim : box);
    if (reaches_out)
        grid_.for_boxes_at(reach, [&](std::uint32_t other) {
            if (other != box) part.obstacles.push_back({other, f});
        });
    box_of_face_[f] = box;
    ++part.places[box];
}

/// Chunks may meet at a vertex. Whatever their order, it ends as the one box of its faces, or as rim.
void BoxedFaces::mark(std::uint32_t local, std::uint32_t box) {
    const std::atomic_ref mark(place_[local]);
    std::uint32_t seen = mark.load(std::memory_order_relaxed);
    while (seen != kRim && seen != box &&
           !mark.compare_exchange_weak(seen, seen == kNone ? box : kRim, std::memory_order_relaxed)) {
    }
}

/// Each part knows where its faces of each box go: after those of the boxes before, and of the parts before.
void BoxedFaces::order_faces(std::vector<Part>& parts, std::uint32_t threads) {
    const std::uint32_t boxes = grid_.box_count();
    start_.resize(boxes + 1);
    std::uint32_t next = 0;
    for (std::uint32_t box = 0; box < boxes; ++box) {
        start_[box] = next;
        for (Part& part : parts) next += std::exchange(part.places[box], next);
    }
    start_[boxes] = next;
    order_.resize(next);
    parallel_for(static_cast<std::uint32_t>(parts.size()), threads, [&](std::uint32_t n) {
        for (std::uint32_t f = n * part_faces_; f < part_end(n); ++f) order_[parts[n].places[box_of_face_[f]]++] = f;
    });
    box_of_face_ = {};
    for (const Part& part : parts) obstacles_.insert(obstacles_.end(), part.obstacles.begin(), part.obstacles.end());
    radix_sort(obstacles_);
}

void BoxedFaces::number_rim() {
    std::uint32_t rim = 0;
    for (std::uint32_t& place : place_) place = place == kRim ? kRim | rim++ : kNone;
}

std::span<const KeyedIndex> BoxedFaces::obstacles_of(std::uint32_t box) const {
    const auto [first, last] = std::equal_range(obstacles_.begin(), obstacles_.end(), KeyedIndex{box, 0},
                                                [](const KeyedIndex& a, const KeyedIndex& b) { return a.key < b.key; });
    return {first, last};
}

std::vector<ChunkVertex> BoxedFaces::rim_vertices() const {
    std::vector<ChunkVertex> rim;
    for (std::uint32_t local = batch_.carried; local < place_.size(); ++local)
        if (is_rim(local)) rim.push_back(vertex(local));
    return rim;
}

}  // namespace regionmesh
