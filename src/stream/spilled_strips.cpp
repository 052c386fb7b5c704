#include "stream/spilled_strips.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <span>

namespace regionmesh {
namespace {

/// Reads `count` items from `offset` to the end of `items`. Returns the offset behind them.
template <class T>
std::uint64_t read_onto(std::vector<T>& items, const TemporaryFile& file, std::uint64_t offset, std::uint64_t count) {
    items.resize(items.size() + count);
    file.read(offset, std::as_writable_bytes(std::span(items).last(count)));
    return offset + count * sizeof(T);
}

}  // namespace

void SpilledStrips::add(const MeshedStrip& strip, double top) {
    const auto number = static_cast<std::uint32_t>(strips_.size());
    strips_.push_back({file_.size(), strip.faces.size(), strip.first_vertex,
                       static_cast<std::uint32_t>(strip.vertices.size()), number, top});
    file_.append_items(std::span<const ChunkVertex>(strip.vertices));
    file_.append_items(std::span<const ChunkFace>(strip.faces));
}

void SpilledStrips::add_finalized(const FinalizedVertex& end) {
    if (!end.is_shared && !end.is_on_hull && !end.is_pinned) return;
    finalized_.add(end);
    if (!end.is_shared) return;
    const auto after = std::upper_bound(strips_.begin(), strips_.end(), end.vertex,
                                        [](std::uint32_t vertex, const Strip& s) { return vertex < s.first_vertex; });
    // A strip without vertices has the first vertex of the next one.
    Strip& own = *std::prev(after);
    own.reach = std::max(own.reach, end.last_strip);
}

void SpilledStrips::finish(bool hull_is_box) {
    hull_is_box_ = hull_is_box;
    finalized_.finish();
    rewind();
}

std::uint64_t SpilledStrips::face_count() const { return faces_of({0, strip_count()}); }

std::uint64_t SpilledStrips::faces_of(StripRange strips) const {
    std::uint64_t sum = 0;
    for (std::uint32_t s = strips.first; s < strips.end; ++s) sum += strips_[s].faces;
    return sum;
}

double SpilledStrips::top_of(StripRange strips) const {
    double top = -HUGE_VAL;
    for (std::uint32_t s = strips.first; s < strips.end; ++s) top = std::max(top, strips_[s].top);
    return top;
}

std::vector<StripRange> SpilledStrips::strips_for_smoothing() const {
    std::vector<StripRange> ranges;
    std::uint32_t end = 0, reach = 0;  // last strip with faces of the vertices of the range before
    while (end < strip_count()) {
        const std::uint32_t first = end, last = std::min(std::max(first, reach), strip_count() - 1);
        end = last + 1;
        reach = 0;
        for (std::uint32_t s = first; s < end; ++s) reach = std::max(reach, strips_[s].reach);
        ranges.push_back({first, end});
    }
    return ranges;
}

void SpilledStrips::rewind() {
    active_.clear();
    finalized_.rewind();
    has_finalized_ = finalized_.next(next_finalized_);
}

SideSet SpilledStrips::sides_of(SideSet of_box, bool is_on_hull, bool is_pinned) const {
    const SideSet sides = hull_is_box_ ? of_box : is_on_hull ? kOnHull : SideSet{0};
    return sides | (is_pinned ? kPinned : SideSet{0});
}

void SpilledStrips::read(StripRange strips, Chunk& chunk) {
    chunk.clear();
    chunk.carried = static_cast<std::uint32_t>(active_.size());
    for (std::uint32_t s = strips.first; s < strips.end; ++s) {
        const std::uint64_t faces_at = read_onto(chunk.vertices, file_, strips_[s].offset, strips_[s].vertices);
        read_onto(chunk.faces, file_, faces_at, strips_[s].faces);
    }
    const std::uint32_t first_vertex = strips_[strips.first].first_vertex;
    for (ChunkVertex& vertex : chunk.vertices) vertex.sides = sides_of(vertex.sides, false, false);
    make_local(chunk, first_vertex);
    // Carried vertices that stay active, in their order; then the new ones.
    std::vector<Active> before = std::move(active_);
    active_.clear();
    for (std::uint32_t n = 0; n < before.size(); ++n) {
        if (before[n].last_strip < strips.end) continue;
        active_.push_back(before[n]);
        chunk.active.push_back(n);
    }
    const std::uint32_t end_vertex = first_vertex + static_cast<std::uint32_t>(chunk.vertices.size());
    for (; has_finalized_ && next_finalized_.vertex < end_vertex; has_finalized_ = finalized_.next(next_finalized_)) {
        const std::uint32_t n = next_finalized_.vertex - first_vertex;
        ChunkVertex& vertex = chunk.vertices[n];
        vertex.sides = sides_of(vertex.sides, next_finalized_.is_on_hull, next_finalized_.is_pinned);
        if (!next_finalized_.is_shared || next_finalized_.last_strip < strips.end) continue;
        active_.push_back({next_finalized_.vertex, next_finalized_.last_strip});
        chunk.active.push_back(chunk.carried + n);
    }
}

/// From the mesher's numbers, which run through all strips, to those of the chunk.
void SpilledStrips::make_local(Chunk& chunk, std::uint32_t first_vertex) const {
    const auto local = [&](std::uint32_t vertex) {
        if (vertex >= first_vertex) return chunk.carried + (vertex - first_vertex);
        const auto at = std::ranges::lower_bound(active_, vertex, {}, &Active::vertex);
        assert(at != active_.end() && at->vertex == vertex);
        return static_cast<std::uint32_t>(at - active_.begin());
    };
    for (ChunkFace& face : chunk.faces) {
        for (std::uint32_t& v : face.vertices) v = local(v);
        for (Label& label : face.labels)
            if (is_exterior(label) && !hull_is_box_) label = exterior(kHull);
    }
}

}  // namespace regionmesh
