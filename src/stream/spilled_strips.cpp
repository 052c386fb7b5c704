#include "stream/spilled_strips.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace regionmesh {

void SpilledStrips::add(const MeshedStrip& strip, double top) {
    const auto number = static_cast<std::uint32_t>(strips_.size());
    strips_.push_back({file_.size(), strip.faces.size(), strip.first_vertex,
                       static_cast<std::uint32_t>(strip.vertices.size()), number, top});
    file_.append_items(std::span<const ChunkVertex>(strip.vertices));
    file_.append_items(std::span<const ChunkFace>(strip.faces));
}

void SpilledStrips::add_end(const VertexEnd& end) {
    if (!end.is_shared && !end.is_on_hull && !end.is_pinned) return;
    ends_.add(end);
    if (!end.is_shared) return;
    const auto after = std::upper_bound(strips_.begin(), strips_.end(), end.vertex,
                                        [](std::uint32_t vertex, const Strip& s) { return vertex < s.first_vertex; });
    // Those without vertices begin where the next one does.
    Strip& own = *std::prev(after);
    own.reach = std::max(own.reach, end.last_strip);
}

void SpilledStrips::finish(bool hull_is_box) {
    hull_is_box_ = hull_is_box;
    ends_.finish();
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

std::vector<StripRange> SpilledStrips::layers() const {
    std::vector<StripRange> layers;
    std::uint32_t end = 0, reach = 0;  // the layer must go on to where the vertices of the one before have faces
    while (end < strip_count()) {
        const std::uint32_t first = end, last = std::min(std::max(first, reach), strip_count() - 1);
        end = last + 1;
        reach = 0;
        for (std::uint32_t s = first; s < end; ++s) reach = std::max(reach, strips_[s].reach);
        layers.push_back({first, end});
    }
    return layers;
}

void SpilledStrips::rewind() {
    open_.clear();
    ends_.rewind();
    has_end_ = ends_.next(next_end_);
}

SideSet SpilledStrips::sides_of(SideSet of_box, bool is_on_hull, bool is_pinned) const {
    const SideSet sides = hull_is_box_ ? of_box : is_on_hull ? kOnHull : SideSet{0};
    return sides | (is_pinned ? kPinned : SideSet{0});
}

void SpilledStrips::read(StripRange strips, Chunk& batch) {
    batch.clear();
    batch.carried = static_cast<std::uint32_t>(open_.size());
    const std::uint32_t first_vertex = strips_[strips.first].first_vertex;
    const auto local = [&](std::uint32_t vertex) {
        if (vertex >= first_vertex) return batch.carried + (vertex - first_vertex);
        const auto at = std::lower_bound(open_.begin(), open_.end(), vertex,
                                         [](const Open& open, std::uint32_t v) { return open.vertex < v; });
        assert(at != open_.end() && at->vertex == vertex);
        return static_cast<std::uint32_t>(at - open_.begin());
    };
    for (std::uint32_t s = strips.first; s < strips.end; ++s) {
        const Strip& strip = strips_[s];
        const std::uint64_t behind = file_.read_items(strip.offset, strip.vertices, vertices_);
        file_.read_items(behind, strip.faces, faces_);
        for (const ChunkVertex& vertex : vertices_)
            batch.vertices.push_back({vertex.position, sides_of(vertex.sides, false, false)});
        for (ChunkFace face : faces_) {
            for (std::uint32_t& v : face.vertices) v = local(v);
            for (Label& label : face.labels)
                if (is_exterior(label) && !hull_is_box_) label = exterior(kHull);
            batch.faces.push_back(face);
        }
    }
    // What was carried and goes on, in its order; then what is new and goes on.
    std::vector<Open> before = std::move(open_);
    open_.clear();
    for (std::uint32_t n = 0; n < before.size(); ++n) {
        if (before[n].last_strip < strips.end) continue;
        open_.push_back(before[n]);
        batch.open.push_back(n);
    }
    const std::uint32_t end_vertex = first_vertex + static_cast<std::uint32_t>(batch.vertices.size());
    for (; has_end_ && next_end_.vertex < end_vertex; has_end_ = ends_.next(next_end_)) {
        const std::uint32_t n = next_end_.vertex - first_vertex;
        ChunkVertex& vertex = batch.vertices[n];
        vertex.sides = sides_of(vertex.sides, next_end_.is_on_hull, next_end_.is_pinned);
        if (!next_end_.is_shared || next_end_.last_strip < strips.end) continue;
        open_.push_back({next_end_.vertex, next_end_.last_strip});
        batch.open.push_back(batch.carried + n);
    }
}

}  // namespace regionmesh
