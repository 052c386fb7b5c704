#include "blocks/own_faces.h"

#include "blocks/gather.h"
#include "regionmesh/error.h"
#include "smooth/lattice/lattice_smoother.h"
#include "stream/stage_options.h"

namespace regionmesh {
namespace {

ChunkOrder order_of(const SourceShape& shape, const Box& wanted) {
    ChunkOrder order = strip_order(shape, 0);
    order.wanted = wanted;
    return order;
}

}  // namespace

std::array<std::uint32_t, 3> halo_of(const SourceShape& shape, const ReconstructOptions& options) {
    if (options.smooth.passes == 0) return {1, 1, 1};
    return lattice_reach(smooth_options(options, shape.scale), {shape.lattice.origin, shape.lattice.spacing});
}

FacesByBlock::FacesByBlock(const BlockGrid& grid, const IndexBox& blocks, int axis)
    : grid_(grid), blocks_(blocks), axis_(axis) {
    const auto size = blocks.size();
    layer_size_ = size[0] * size[1] * size[2] / size[axis];
}

/// Null for a block outside of the box, and of a layer that has ended.
FacesByBlock::Own* FacesByBlock::find(std::uint32_t block) {
    const std::array<std::uint32_t, 3> place = grid_.place(block);
    for (int n = 0; n < 3; ++n)
        if (place[n] < blocks_.low[n] || place[n] >= blocks_.high[n]) return nullptr;
    const int u = axis_ == 0 ? 1 : 0, v = axis_ == 2 ? 1 : 2;
    const std::size_t slot = std::size_t{place[axis_] - blocks_.low[axis_]} * layer_size_ +
                             (place[v] - blocks_.low[v]) * blocks_.size()[u] + place[u] - blocks_.low[u];
    if (slot >= open_.size()) open_.resize((place[axis_] - blocks_.low[axis_] + 1) * std::size_t{layer_size_});
    return &open_[slot];
}

const ChunkVertex& FacesByBlock::vertex(const Chunk& strip, std::uint32_t local) const {
    return local < strip.carried ? states_[local].vertex : strip.vertices[local - strip.carried];
}

void FacesByBlock::add(const Chunk& strip) {
    states_.resize(strip.carried);
    states_.resize(strip.carried + strip.vertices.size());
    for (const ChunkFace& face : strip.faces) {
        const auto& v = face.vertices;
        const std::uint32_t block =
            block_of(grid_, {vertex(strip, v[0]).position, vertex(strip, v[1]).position, vertex(strip, v[2]).position});
        Own* own = find(block);
        ChunkFace made{{}, face.labels};
        for (int n = 0; n < 3; ++n) made.vertices[n] = number(strip, v[n], own ? block : kNone, own);
        if (own) own->faces.faces.push_back(made);
    }
    carry(strip);
}

/// The number that a vertex has in a block. A vertex that has two is shared in both.
std::uint32_t FacesByBlock::number(const Chunk& strip, std::uint32_t local, std::uint32_t block, Own* own) {
    State& state = states_[local];
    for (std::uint32_t use = state.uses; use != kNone; use = uses_[use].next)
        if (uses_[use].block == block) return uses_[use].number;
    Use made{block, kNone, state.uses};
    if (own) {
        made.number = static_cast<std::uint32_t>(own->faces.vertices.size());
        own->faces.vertices.push_back(vertex(strip, local));
        own->is_shared.push_back(made.next != kNone);
    }
    for (std::uint32_t use = made.next; use != kNone; use = uses_[use].next)
        if (Own* other = uses_[use].block == kNone ? nullptr : find(uses_[use].block))
            other->is_shared[uses_[use].number] = true;
    state.uses = static_cast<std::uint32_t>(uses_.size());
    uses_.push_back(made);
    return made.number;
}

/// Keeps the active vertices, in their order, and what uses them.
void FacesByBlock::carry(const Chunk& strip) {
    std::vector<State> next;
    std::vector<Use> uses;
    next.reserve(strip.active.size());
    for (const std::uint32_t local : strip.active) {
        State kept{vertex(strip, local)};
        for (std::uint32_t use = states_[local].uses; use != kNone; use = uses_[use].next) {
            uses.push_back({uses_[use].block, uses_[use].number, kept.uses});
            kept.uses = static_cast<std::uint32_t>(uses.size() - 1);
        }
        next.push_back(kept);
    }
    states_ = std::move(next);
    uses_ = std::move(uses);
}

Chunk FacesByBlock::take(std::uint32_t block) {
    Own own = std::exchange(*find(block), {});
    for (std::uint32_t v = 0; v < own.is_shared.size(); ++v)
        if (own.is_shared[v]) own.faces.active.push_back(v);
    return std::move(own.faces);
}

/// Vertices between this layer and the next may still be carried; their uses here no longer count.
void FacesByBlock::end_layer() {
    for (Use& use : uses_)
        if (use.block != kNone && grid_.place(use.block)[axis_] == blocks_.low[axis_]) use.block = kNone;
    open_.erase(open_.begin(), open_.begin() + std::min<std::ptrdiff_t>(layer_size_, std::ssize(open_)));
    ++blocks_.low[axis_];
}

OwnFaces::OwnFaces(const BlockVolume& volume, const BlockGrid& grid, const IndexBox& blocks,
                   const ReconstructOptions& options)
    : grid_(grid),
      blocks_(blocks),
      samples_(samples_with_halo(grid.cells(blocks), halo_of(volume.shape, options), volume.shape.lattice.size)),
      axis_(volume.shape.axis()),
      source_(volume, samples_),
      strips_(source_, smooth_options(options, volume.shape.scale), order_of(source_.shape(), grid.limits(blocks)),
              log_),
      faces_(grid, blocks, axis_) {}

std::optional<std::uint32_t> OwnFaces::next(Chunk& faces) {
    if (ready_.empty()) {
        if (blocks_.low[axis_] == blocks_.high[axis_]) return {};
        read_layer();
    }
    const std::uint32_t block = ready_.back();
    ready_.pop_back();
    faces = faces_.take(block);
    if (ready_.empty()) {
        faces_.end_layer();
        ++blocks_.low[axis_];
    }
    return block;
}

/// Reads one strip more than the layer has, whose faces share vertices with those of the layer.
void OwnFaces::read_layer() {
    IndexBox layer = blocks_;
    layer.high[axis_] = layer.low[axis_] + 1;
    const std::uint32_t end = grid_.cells(layer).high[axis_] - samples_.low[axis_];
    for (Chunk strip; strips_.count() <= end && strips_.next(strip);) faces_.add(strip);
    grid_.for_blocks(layer, [&](std::uint32_t block) { ready_.push_back(block); });
    std::reverse(ready_.begin(), ready_.end());
}

}  // namespace regionmesh
