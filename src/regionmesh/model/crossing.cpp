#include "regionmesh/model/crossing.h"

#include <algorithm>

#include "regionmesh/base/parallel_for.h"
#include "regionmesh/base/radix_sort.h"
#include "regionmesh/model/exact_predicates.h"
#include "regionmesh/model/face_meeting.h"

namespace regionmesh {
namespace {

using Pairs = std::vector<FacePair>;

constexpr std::uint32_t kStars = 1 << 12, kParts = 8;  // looked at together

Corner corner(FaceId f, int place) { return index(f) << 2 | static_cast<Corner>(place); }

/// All corners of some faces, vertex by vertex: what is left of each star.
class Window {
public:
    Window(const Model& model, const std::vector<FaceId>& faces) {
        corners_.reserve(3 * faces.size());
        for (FaceId f : faces)
            for (int place = 0; place < 3; ++place)
                corners_.push_back({index(model[f].vertices[place]), corner(f, place)});
        radix_sort(corners_);
        for (std::uint32_t n = 0; n < corners_.size(); ++n)
            if (n == 0 || corners_[n].key != corners_[n - 1].key) starts_.push_back(n);
        starts_.push_back(static_cast<std::uint32_t>(corners_.size()));
    }

    std::uint32_t star_count() const { return static_cast<std::uint32_t>(starts_.size()) - 1; }
    VertexId star(std::uint32_t n, std::vector<Corner>& corners) const {
        for (std::uint32_t c = starts_[n]; c < starts_[n + 1]; ++c) corners.push_back(corners_[c].index);
        return VertexId{corners_[starts_[n]].key};
    }

private:
    std::vector<KeyedIndex> corners_;    // by vertex
    std::vector<std::uint32_t> starts_;  // of each star
};

bool cross(const Model& model, FaceId f, FaceId g) {
    const auto p = model.corners(f), q = model.corners(g);
    if (are_apart(p, q) || is_degenerate({p[0], p[1], p[2]}) || is_degenerate({q[0], q[1], q[2]})) return false;
    return meet_outside_shared({model[f].vertices, p}, {model[g].vertices, q});
}

/// Adds the pairs that share no vertex, of one part of the tree.
void cross_apart(const Model& model, const SortedFaceTree& tree, std::uint32_t part, Pairs& found) {
    Pairs strangers;
    tree.boxes().visit_pairs(part, [&](std::span<const BoxTree::Pair> pairs) {
        strangers.resize(std::max(strangers.size(), pairs.size()));
        std::size_t count = 0;
        for (const BoxTree::Pair pair : pairs) {
            const FaceId f = tree.face(pair.m()), g = tree.face(pair.n());
            strangers[count] = {f, g};
            count += !share_vertex(model[f].vertices, model[g].vertices);
        }
        for (std::size_t n = 0; n < count; ++n) {
            const auto [f, g] = strangers[n];
            if (cross(model, f, g)) found.push_back({std::min(f, g), std::max(f, g)});
        }
    });
}

/// Two passes, each of which only reads the model: faces that share a vertex, star by star; and those that do not.
/// star(n, corners) adds the corners of star n and returns its vertex.
template <class Star>
Pairs find_all(const Model& model, const SortedFaceTree& tree, std::uint32_t star_count, std::uint32_t threads,
               Star&& star) {
    Pairs all;
    const auto append = [&](const Pairs& found) { all.insert(all.end(), found.begin(), found.end()); };
    const auto in_stars = [&](std::uint32_t first, std::uint32_t end) {
        Pairs found;
        StarCrossing crossing;
        std::vector<Corner> corners;
        for (std::uint32_t n = first; n < end; ++n) {
            corners.clear();
            const VertexId v = star(n, corners);
            crossing.find(model, v, corners, found);
        }
        return found;
    };
    const auto in_parts = [&](std::uint32_t first, std::uint32_t end) {
        Pairs found;
        for (std::uint32_t part = first; part < end; ++part) cross_apart(model, tree, part, found);
        return found;
    };
    for_chunks(star_count, kStars, threads, in_stars, append);
    for_chunks(tree.boxes().part_count(), kParts, threads, in_parts, append);
    std::sort(all.begin(), all.end());
    return all;
}

}  // namespace

std::vector<FacePair> find_crossings(const Model& model, const SortedFaceTree& tree, std::uint32_t threads) {
    return find_all(model, tree, model.vertex_end(), threads, [&](std::uint32_t n, std::vector<Corner>& corners) {
        const VertexId v{n};
        if (model.is_alive(v)) model.for_star(v, [&](FaceId f, int place) { corners.push_back(corner(f, place)); });
        return v;
    });
}

std::vector<FacePair> find_crossings(const Model& model, const std::vector<FaceId>& faces, std::uint32_t threads) {
    const SortedFaceTree tree(model, faces, threads);
    const Window window(model, faces);
    return find_all(model, tree, window.star_count(), threads,
                    [&](std::uint32_t n, std::vector<Corner>& corners) { return window.star(n, corners); });
}

}  // namespace regionmesh
