#include "regionmesh/model/crossing.h"

#include <algorithm>

#include "regionmesh/base/parallel_for.h"
#include "regionmesh/model/exact_predicates.h"
#include "regionmesh/model/face_meeting.h"

namespace regionmesh {
namespace {

using Pairs = std::vector<FacePair>;

/// The first pass: faces that share a vertex, vertex by vertex.
Pairs cross_in_stars(const Model& model, std::uint32_t first, std::uint32_t end) {
    Pairs found;
    StarCrossing star;
    std::vector<Corner> corners;
    for (std::uint32_t n = first; n < end; ++n) {
        if (!model.is_alive(VertexId{n})) continue;
        corners.clear();
        model.for_star(VertexId{n}, [&](FaceId f, int place) { corners.push_back(index(f) << 2 | static_cast<Corner>(place)); });
        star.find(model, VertexId{n}, corners, found);
    }
    return found;
}

bool cross(const Model& model, FaceId f, FaceId g) {
    const auto p = model.corners(f), q = model.corners(g);
    if (are_apart(p, q) || is_degenerate({p[0], p[1], p[2]}) || is_degenerate({q[0], q[1], q[2]})) return false;
    return meet_outside_shared({model[f].vertices, p}, {model[g].vertices, q});
}

/// The second pass: faces that share none, part by part of the tree.
Pairs cross_apart(const Model& model, const SortedFaceTree& tree, std::uint32_t part) {
    Pairs found, strangers;
    tree.boxes().visit_pairs(part, [&](std::span<const BoxTree::Pair> pairs) {
        strangers.resize(std::max(strangers.size(), pairs.size()));
        std::size_t count = 0;
        for (const BoxTree::Pair pair : pairs) {
            const FaceId f = tree.face(pair.m()), g = tree.face(pair.n());
            strangers[count] = {f, g};
            count += !share_vertex(model[f].vertices, model[g].vertices);
        }
        for (const auto [f, g] : std::span(strangers).first(count))
            if (cross(model, f, g)) found.push_back({std::min(f, g), std::max(f, g)});
    });
    return found;
}

}  // namespace

std::vector<FacePair> find_crossings(const Model& model, const SortedFaceTree& tree, std::uint32_t threads) {
    Pairs all;
    const auto append = [&](const Pairs& found) { all.insert(all.end(), found.begin(), found.end()); };
    for_chunks(
        model.vertex_end(), 1 << 11, threads,
        [&](std::uint32_t first, std::uint32_t end) { return cross_in_stars(model, first, end); }, append);
    for_chunks(
        tree.boxes().part_count(), 4, threads,
        [&](std::uint32_t first, std::uint32_t end) {
            Pairs found;
            for (std::uint32_t part = first; part < end; ++part) {
                const Pairs more = cross_apart(model, tree, part);
                found.insert(found.end(), more.begin(), more.end());
            }
            return found;
        },
        append);
    std::sort(all.begin(), all.end());
    return all;
}

}  // namespace regionmesh
