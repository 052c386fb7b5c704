#include "smooth/filters/intersection_resolver.h"

#include <algorithm>

#include "base/box.h"
#include "base/exact_predicates.h"
#include "base/parallel_for.h"

namespace regionmesh {
namespace {

using smoothing::kCrossingTask, smoothing::kResolveStep;

}  // namespace

bool IntersectionResolver::add_chunk(std::uint32_t chunk) {
    resolved_end_ = chunk + 1;
    const NumberRange own = window_.faces_of(chunk);
    std::vector<std::uint32_t> faces(own.size());
    for (std::uint32_t n = 0; n < own.size(); ++n) faces[n] = own.first + n;
    if (options_.intersect_check) {
        build_tree(chunk);
        const auto ended = parts_.that_end_in(window_, chunk);
        island_vertices_.insert(island_vertices_.end(), ended.begin(), ended.end());
    }
    NumberRange whole = own;
    for (;;) {
        bool is_valid = !request_faulty_shapes(faces);
        if (options_.intersect_check) {
            if (request_crossings(faces, whole)) is_valid = false;
            if (request_islands()) is_valid = false;
            if (request_inverted()) is_valid = false;
        }
        if (is_valid) return true;
        if (requested_.empty()) return false;
        faces = apply_requests();
        whole = {};
    }
}

void IntersectionResolver::build_tree(std::uint32_t chunk) {
    const NumberRange faces = window_.faces_of(chunk);
    std::vector<Box> boxes(faces.size());
    Box bounds;
    for (std::uint32_t n = 0; n < faces.size(); ++n) {
        for (std::uint32_t v : window_.faces[faces.first + n].vertices) {
            boxes[n].add(window_.origin[v]);
            boxes[n].add((*steps_.smooth)[v]);
        }
        bounds.add(boxes[n].low);
        bounds.add(boxes[n].high);
    }
    const auto box_of = [&](FaceId f) { return boxes[index(f)]; };
    trees_.push_back({chunk, faces.first, bounds, SortedFaceTree(faces.size(), bounds, box_of, options_.threads)});
}

PlacedFace IntersectionResolver::placed(std::uint32_t f) const {
    PlacedFace face;
    for (int n = 0; n < 3; ++n) {
        const std::uint32_t v = window_.faces[f].vertices[n];
        face.vertices[n] = VertexId{v};
        face.at[n] = (*steps_.now)[v];
    }
    return face;
}

/// Calls visit(face number) for all faces held whose box meets the one given.
template <class Visit>
void IntersectionResolver::for_near(const Box& box, Visit&& visit) const {
    for (const ChunkTree& held : trees_) {
        if (!overlap(box, held.bounds)) continue;
        held.tree.search(box, [&](FaceId f) {
            visit(held.first_face + index(f));
            return true;
        });
    }
}

/// A face whose vertices all stay at their origins is as valid as it was.
bool IntersectionResolver::is_unsmoothed(std::uint32_t f) const {
    const auto& v = window_.faces[f].vertices;
    return std::all_of(v.begin(), v.end(), [&](std::uint32_t n) { return steps_.backtrack[n] == kFullBacktrack; });
}

void IntersectionResolver::request(std::uint32_t v) {
    const bool cannot_move = v < window_.vertices_of(first_movable_).first || steps_.backtrack[v] == kFullBacktrack;
    if (cannot_move || steps_.wanted[v] > steps_.backtrack[v]) return;
    steps_.wanted[v] = std::min<std::uint8_t>(steps_.backtrack[v] + kResolveStep, kFullBacktrack);
    requested_.push_back(v);
}

void IntersectionResolver::request_corners(std::uint32_t f) {
    for (std::uint32_t v : window_.faces[f].vertices) request(v);
}

/// Moves the vertices requested, and returns the faces that have moved.
std::vector<std::uint32_t> IntersectionResolver::apply_requests() {
    const std::uint32_t first = window_.vertices_of(first_movable_).first;
    std::vector<bool> has_moved(window_.vertices_of(resolved_end_ - 1).end - first);
    for (std::uint32_t v : requested_) {
        steps_.set_backtrack(window_, v, steps_.wanted[v]);
        has_moved[v - first] = true;
    }
    requested_.clear();
    std::vector<std::uint32_t> faces;
    for (std::uint32_t f = window_.faces_of(first_movable_).first; f < window_.faces_of(resolved_end_ - 1).end; ++f) {
        const auto& v = window_.faces[f].vertices;
        if (std::any_of(v.begin(), v.end(), [&](std::uint32_t n) { return n >= first && has_moved[n - first]; }))
            faces.push_back(f);
    }
    return faces;
}

bool IntersectionResolver::request_faulty_shapes(const std::vector<std::uint32_t>& faces) {
    bool any = false;
    for (std::uint32_t f : faces) {
        std::array<Vec3, 3> before;
        for (int n = 0; n < 3; ++n) before[n] = window_.origin[window_.faces[f].vertices[n]];
        if (shape_fault(before, placed(f).at, options_.min_quality) == ShapeFault::kNone || is_unsmoothed(f)) continue;
        request_corners(f);
        any = true;
    }
    return any;
}

/// Tests the faces against all others. `whole` is empty or the range of all of `faces`: pairs within it are tested
/// once.
bool IntersectionResolver::request_crossings(const std::vector<std::uint32_t>& faces, NumberRange whole) {
    const auto count = static_cast<std::uint32_t>(faces.size());
    std::vector<std::vector<Pair>> found((count + kCrossingTask - 1) / kCrossingTask);
    parallel_for(static_cast<std::uint32_t>(found.size()), options_.threads, [&](std::uint32_t part) {
        for (std::uint32_t n = part * kCrossingTask; n < std::min(count, (part + 1) * kCrossingTask); ++n) {
            const std::uint32_t f = faces[n];
            const PlacedFace own = placed(f);
            if (is_degenerate({own.at[0], own.at[1], own.at[2]})) continue;
            for_near(box_of(own.at), [&](std::uint32_t g) {
                if (g == f || (g > f && g >= whole.first && g < whole.end)) return;
                const PlacedFace other = placed(g);
                if (!boxes_overlap(own.at, other.at)) return;
                if (is_degenerate({other.at[0], other.at[1], other.at[2]})) return;
                if (meet_outside_shared(own, other) && !(is_unsmoothed(f) && is_unsmoothed(g)))
                    found[part].push_back({f, g});
            });
        }
    });
    bool any = false;
    for (const auto& part : found) {
        for (const Pair pair : part) {
            request_corners(pair.f);
            request_corners(pair.g);
            ++crossings_;
            any = true;
        }
    }
    return any;
}

bool IntersectionResolver::request_islands() {
    bool any = false;
    for (std::uint32_t v : island_vertices_) {
        const std::uint32_t part = parts_.root(v);
        const Vec3 before = window_.origin[v], after = (*steps_.now)[v];
        Box way;
        way.add(before);
        way.add(after);
        bool changes = false;
        for_near(way, [&](std::uint32_t f) {
            const ChunkFace& face = window_.faces[f];
            if (parts_.root(face.vertices[0]) == part) return;
            MovedFace moved{face.vertices, {}, placed(f).at};
            for (int n = 0; n < 3; ++n) moved.before[n] = window_.origin[face.vertices[n]];
            if (!may_change_sides(before, after, moved)) return;
            if (steps_.backtrack[v] == kFullBacktrack && is_unsmoothed(f)) return;
            request_corners(f);
            request(v);
            changes = true;
        });
        if (!changes) continue;
        ++islands_;
        any = true;
    }
    return any;
}

bool IntersectionResolver::request_inverted() {
    if (!shells_) return false;
    const std::vector<std::uint32_t> faces = shells_->inverted(window_, *steps_.now);
    for (std::uint32_t f : faces) request_corners(f);
    return !faces.empty();
}

void IntersectionResolver::release_before(std::uint32_t chunk) {
    first_movable_ = chunk;
    while (!trees_.empty() && trees_.front().chunk < chunk) trees_.pop_front();
    const std::uint32_t first = window_.vertices_of(chunk).first;
    std::erase_if(island_vertices_, [&](std::uint32_t v) { return v < first; });
}

std::size_t IntersectionResolver::bytes() const {
    std::size_t sum = parts_.bytes();
    for (const ChunkTree& held : trees_) sum += held.tree.bytes();
    return sum;
}

}  // namespace regionmesh
