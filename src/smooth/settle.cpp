#include "smooth/settle.h"

#include <algorithm>

#include "base/exact_predicates.h"
#include "base/parallel_for.h"

namespace regionmesh {
namespace {

constexpr std::uint32_t kChunk = 512;  // faces
constexpr std::uint8_t kStep = 2;

bool do_overlap(const Box& a, const Box& b) {
    for (int axis = 0; axis < 3; ++axis)
        if (a.low[axis] > b.high[axis] || a.high[axis] < b.low[axis]) return false;
    return true;
}

}  // namespace

void Settling::add_layer(std::uint32_t layer) {
    settled_end_ = layer + 1;
    const NumberRange own = window_.faces_of(layer);
    std::vector<std::uint32_t> faces(own.size());
    for (std::uint32_t n = 0; n < own.size(); ++n) faces[n] = own.first + n;
    if (options_.intersect_check) {
        build_tree(layer);
        const auto ended = parts_.that_end_in(window_, layer);
        speakers_.insert(speakers_.end(), ended.begin(), ended.end());
    }
    NumberRange whole = own;
    for (;;) {
        bool is_sound = !raise_faulty_shapes(faces);
        if (options_.intersect_check) {
            if (raise_crossing(faces, whole)) is_sound = false;
            if (raise_islands()) is_sound = false;
        }
        if (is_sound) return;
        if (raised_.empty()) throw HeldTooFew(layer);
        faces = step_back_raised();
        whole = {};
    }
}

void Settling::build_tree(std::uint32_t layer) {
    const NumberRange faces = window_.faces_of(layer);
    std::vector<Box> boxes(faces.size());
    Box bounds;
    for (std::uint32_t n = 0; n < faces.size(); ++n) {
        for (std::uint32_t v : window_.faces[faces.first + n].vertices) {
            boxes[n].add(window_.origin[v]);
            boxes[n].add((*stand_.smooth)[v]);
        }
        bounds.add(boxes[n].low);
        bounds.add(boxes[n].high);
    }
    const auto box_of = [&](FaceId f) { return boxes[index(f)]; };
    trees_.push_back({layer, faces.first, bounds, SortedFaceTree(faces.size(), bounds, box_of, options_.threads)});
}

PlacedFace Settling::placed(std::uint32_t f) const {
    PlacedFace face;
    for (int n = 0; n < 3; ++n) {
        const std::uint32_t v = window_.faces[f].vertices[n];
        face.vertices[n] = VertexId{v};
        face.at[n] = (*stand_.now)[v];
    }
    return face;
}

/// Calls visit(face number) for all faces held whose box meets the one given.
template <class Visit>
void Settling::for_near(const Box& box, Visit&& visit) const {
    for (const LayerTree& layer : trees_) {
        if (!do_overlap(box, layer.bounds)) continue;
        layer.tree.search(box, [&](FaceId f) {
            visit(layer.first_face + index(f));
            return true;
        });
    }
}

/// A face that stands where it came from is as good as it was.
bool Settling::is_as_it_came(std::uint32_t f) const {
    const auto& v = window_.faces[f].vertices;
    return std::all_of(v.begin(), v.end(), [&](std::uint32_t n) { return stand_.level[n] == kFullyBack; });
}

void Settling::raise(std::uint32_t v) {
    const bool stands_fast = v < window_.vertices_of(first_free_).first || stand_.level[v] == kFullyBack;
    if (stands_fast || stand_.wanted[v] > stand_.level[v]) return;
    stand_.wanted[v] = std::min<std::uint8_t>(stand_.level[v] + kStep, kFullyBack);
    raised_.push_back(v);
}

void Settling::raise_corners(std::uint32_t f) {
    for (std::uint32_t v : window_.faces[f].vertices) raise(v);
}

/// Moves what was raised, and returns the faces so far that have moved.
std::vector<std::uint32_t> Settling::step_back_raised() {
    const std::uint32_t first = window_.vertices_of(first_free_).first;
    std::vector<bool> has_moved(window_.vertices_of(settled_end_ - 1).end - first);
    for (std::uint32_t v : raised_) {
        stand_.set_level(window_, v, stand_.wanted[v]);
        has_moved[v - first] = true;
    }
    raised_.clear();
    std::vector<std::uint32_t> faces;
    for (std::uint32_t f = window_.faces_of(first_free_).first; f < window_.faces_of(settled_end_ - 1).end; ++f) {
        const auto& v = window_.faces[f].vertices;
        if (std::any_of(v.begin(), v.end(), [&](std::uint32_t n) { return n >= first && has_moved[n - first]; }))
            faces.push_back(f);
    }
    return faces;
}

bool Settling::raise_faulty_shapes(const std::vector<std::uint32_t>& faces) {
    bool any = false;
    for (std::uint32_t f : faces) {
        std::array<Vec3, 3> before;
        for (int n = 0; n < 3; ++n) before[n] = window_.origin[window_.faces[f].vertices[n]];
        if (shape_fault(before, placed(f).at, options_.min_quality) == ShapeFault::kNone || is_as_it_came(f)) continue;
        raise_corners(f);
        any = true;
    }
    return any;
}

/// Tests the faces against all others; of the pairs within `whole`, which holds none or all of the faces, each once.
bool Settling::raise_crossing(const std::vector<std::uint32_t>& faces, NumberRange whole) {
    const auto count = static_cast<std::uint32_t>(faces.size());
    std::vector<std::vector<Pair>> found((count + kChunk - 1) / kChunk);
    parallel_for(static_cast<std::uint32_t>(found.size()), options_.threads, [&](std::uint32_t part) {
        for (std::uint32_t n = part * kChunk; n < std::min(count, (part + 1) * kChunk); ++n) {
            const std::uint32_t f = faces[n];
            const PlacedFace own = placed(f);
            if (is_degenerate({own.at[0], own.at[1], own.at[2]})) continue;
            Box box;
            for (Vec3 p : own.at) box.add(p);
            for_near(box, [&](std::uint32_t g) {
                if (g == f || (g > f && g >= whole.first && g < whole.end)) return;
                const PlacedFace other = placed(g);
                if (!boxes_overlap(own.at, other.at)) return;
                if (is_degenerate({other.at[0], other.at[1], other.at[2]})) return;
                if (meet_outside_shared(own, other) && !(is_as_it_came(f) && is_as_it_came(g)))
                    found[part].push_back({f, g});
            });
        }
    });
    bool any = false;
    for (const auto& part : found) {
        for (const Pair pair : part) {
            raise_corners(pair.f);
            raise_corners(pair.g);
            ++crossings_;
            any = true;
        }
    }
    return any;
}

bool Settling::raise_islands() {
    bool any = false;
    for (std::uint32_t v : speakers_) {
        const std::uint32_t part = parts_.root(v);
        const Vec3 before = window_.origin[v], after = (*stand_.now)[v];
        Box way;
        way.add(before);
        way.add(after);
        bool changes = false;
        for_near(way, [&](std::uint32_t f) {
            const WindowFace& face = window_.faces[f];
            if (parts_.root(face.vertices[0]) == part) return;
            MovedFace moved{face.vertices, {}, placed(f).at};
            for (int n = 0; n < 3; ++n) moved.before[n] = window_.origin[face.vertices[n]];
            if (!may_change_sides(before, after, moved)) return;
            if (stand_.level[v] == kFullyBack && is_as_it_came(f)) return;
            raise_corners(f);
            raise(v);
            changes = true;
        });
        if (!changes) continue;
        ++islands_;
        any = true;
    }
    return any;
}

void Settling::let_go_before(std::uint32_t layer) {
    first_free_ = layer;
    while (!trees_.empty() && trees_.front().layer < layer) trees_.pop_front();
    const std::uint32_t first = window_.vertices_of(layer).first;
    std::erase_if(speakers_, [&](std::uint32_t v) { return v < first; });
}

std::size_t Settling::bytes() const {
    std::size_t sum = parts_.bytes();
    for (const LayerTree& layer : trees_) sum += layer.tree.bytes();
    return sum;
}

}  // namespace regionmesh
