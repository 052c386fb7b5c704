#include "cells/tetrahedron_mesher.h"

#include <algorithm>
#include <array>
#include <bit>
#include <string>

#include "regionmesh/error.h"
#include "regionmesh/limits.h"

namespace regionmesh {
namespace {

constexpr CornerSet kWhole = 0b1111;
constexpr std::array<std::uint8_t, 16> kSizes{0, 1, 1, 2, 1, 2, 2, 3, 1, 2, 2, 3, 2, 3, 3, 4};  // sizes of corner sets
constexpr std::uint8_t kMostLabels = 4, kManyLabels = 5;  // labels at a vertex of a generic mesh; more than that

/// The corners of a set, as a key.
SimplexKey key_of(const std::array<std::uint32_t, 4>& corners, CornerSet set) {
    SimplexKey key{kNoRank, kNoRank, kNoRank};
    int n = 0;
    for (int c = 0; c < 4; ++c)
        if (set >> c & 1) key[n++] = corners[c];
    return key;
}

std::span<const std::uint32_t> corners_of(const SimplexKey& key) {
    return {key.data(), key[1] == kNoRank ? 1u : key[2] == kNoRank ? 2u : 3u};
}

bool is_triangle(const SimplexKey& key) { return key[2] != kNoRank; }

/// Does the face opposite this corner, in the order of ranks, point out of the tetrahedron?
bool is_outward_but(int opposite, bool is_mirrored) { return (opposite % 2 == 1) == is_mirrored; }

}  // namespace

TetrahedronMesher::TetrahedronMesher(const RankedPoints& points, const TetrahedronReader& reader, StripOptions options)
    : points_(points),
      reader_(reader),
      has_cell_labels_(reader.info().has_cell_labels),
      options_(std::move(options)),
      is_used_(points.size()) {}

void TetrahedronMesher::begin_strip(std::uint32_t strip) {
    strip_ = strip;
    made_.first_vertex += static_cast<std::uint32_t>(made_.vertices.size());
    made_.vertices.clear();
    made_.faces.clear();
}

std::uint64_t TetrahedronMesher::bytes() const {
    return simplices_.bytes() + label_uses_.bytes() + made_.vertices.capacity() * sizeof(ChunkVertex) +
           made_.faces.capacity() * sizeof(ChunkFace) + finalized_.capacity() * sizeof(FinalizedVertex);
}

void TetrahedronMesher::add(const RankedTetrahedron& tetrahedron) {
    const Places places = find_simplices(tetrahedron);
    if (has_cell_labels_)
        count_cell(tetrahedron, places);
    else
        mesh(tetrahedron, places);
}

/// Finds its edges and triangles, and its nodes where tetrahedra have the labels. Counts the new ones.
TetrahedronMesher::Places TetrahedronMesher::find_simplices(const RankedTetrahedron& tetrahedron) {
    Places places;
    for (CornerSet set = 1; set < kWhole; ++set) {
        const int size = kSizes[set];
        if (size == 1) {
            const std::uint32_t rank = tetrahedron.corners[std::countr_zero(set)];
            if (has_cell_labels_) places[set] = place_of({rank, kNoRank, kNoRank});
            if (!has_cell_labels_ && !is_used_[rank]) euler(points_.labels[rank]) += 2;
            is_used_[rank] = true;
            continue;
        }
        bool is_new = false;
        const SimplexKey key = key_of(tetrahedron.corners, set);
        places[set] = simplices_.find_or_add(key, &is_new);
        if (size == 3) {
            meet_triangle(tetrahedron, std::countr_zero(CornerSet(kWhole & ~set)), places[set]);
        } else if (is_new && !has_cell_labels_ && points_.labels[key[0]] != points_.labels[key[1]]) {
            pairs_.add(points_.labels[key[0]], points_.labels[key[1]]);
        }
        if (!is_new || has_cell_labels_) continue;
        const Label label = points_.labels[key[0]];
        const auto corners = corners_of(key);
        if (std::all_of(corners.begin(), corners.end(), [&](std::uint32_t r) { return points_.labels[r] == label; }))
            euler(label) += size == 2 ? -2 : 2;
    }
    return places;
}

/// The first tetrahedron at a triangle notes its label; the second makes a face where its own label differs.
void TetrahedronMesher::meet_triangle(const RankedTetrahedron& tetrahedron, int opposite, std::uint32_t place) {
    const SimplexKey key = simplices_[place].corners;
    Note& note = simplices_[place].note;
    if (++note.seen == 1) {
        note.label = tetrahedron.label;
        note.is_outward = is_outward_but(opposite, tetrahedron.is_mirrored);
        return;
    }
    if (note.seen > 2) fail_at(key, "three tetrahedra share one triangle");
    if (note.is_outward == is_outward_but(opposite, tetrahedron.is_mirrored))
        fail_at(key, "two tetrahedra lie on the same side of one triangle");
    if (!has_cell_labels_ || note.label == tetrahedron.label) return;
    pairs_.add(note.label, tetrahedron.label);
    ++euler(note.label);
    ++euler(tetrahedron.label);
    const Label first = note.label;
    const bool turn = !note.is_outward;
    add_face({key[0], key[turn ? 2 : 1], key[turn ? 1 : 2]}, first, tetrahedron.label);
}

void TetrahedronMesher::fail_at(const SimplexKey& triangle, const char* text) const {
    std::string where;
    for (std::uint32_t rank : triangle) where += ", " + reader_.name_of_point(points_.points[rank]);
    throw Error(ErrorCode::kInput,
                reader_.info().source + ": " + text + ", that of" + where.substr(1) + ": mend the mesh");
}

/// A face between nodes.
void TetrahedronMesher::add_face(const SimplexKey& corners, Label first, Label second) {
    ChunkFace face{{}, {first, second}};
    for (int n = 0; n < 3; ++n) face.vertices[n] = vertex(place_of({corners[n], kNoRank, kNoRank}));
    made_.faces.push_back(face);
}

/// The faces of a patch; `vertex_of` and `middle_of` are the number and the place of the vertex of a set of corners.
template <class VertexOf, class MiddleOf>
void TetrahedronMesher::add_patch(const CasePatch& patch, bool turn, const std::array<Label, 2>& labels,
                                  VertexOf&& vertex_of, MiddleOf&& middle_of) {
    int start = 0;
    if (patch.vertex_count == 4) {
        std::array<Vec3, 4> quad;
        for (int n = 0; n < 4; ++n) quad[n] = middle_of(patch.vertices[n]);
        start = better_cut(quad);
    }
    std::array<CaseFace, 2> faces;
    const int count = patch.cut(start, turn, faces);
    for (int f = 0; f < count; ++f) {
        ChunkFace made{{}, labels};
        for (int n = 0; n < 3; ++n) made.vertices[n] = vertex_of(faces[f].vertices[n]);
        made_.faces.push_back(made);
    }
}

void TetrahedronMesher::mesh(const RankedTetrahedron& tetrahedron, const Places& places) {
    const auto& corners = tetrahedron.corners;
    std::array<Label, 4> label;
    for (int n = 0; n < 4; ++n) label[n] = points_.labels[corners[n]];
    const unsigned pattern = tetrahedron_pattern(label[0], label[1], label[2], label[3]);
    if (pattern == 0) {
        euler(label[0]) -= 2;
        return;
    }
    std::array<std::uint32_t, 16> number{};  // number of the vertex + 1; index: CornerSet
    const auto vertex_at = [&](CornerSet set) {
        if (number[set] == 0) number[set] = (set == kWhole ? inner_vertex(tetrahedron) : vertex(places[set])) + 1;
        return number[set] - 1;
    };
    if (pattern == 63) ++quadruple_points_;
    const auto middle_of = [&](CornerSet set) {
        return set == kWhole ? centroid(corners) : centroid(corners_of(key_of(corners, set)));
    };
    for (const CasePatch& patch : tetrahedron_patches_[pattern])
        add_patch(patch, patch.turns != bool(tetrahedron.is_mirrored), {label[patch.first], label[patch.second]},
                  vertex_at, middle_of);
}

/// Notes the label at nodes and edges.
void TetrahedronMesher::count_cell(const RankedTetrahedron& tetrahedron, const Places& places) {
    for (CornerSet set = 1; set < kWhole; ++set) {
        if (kSizes[set] == 3) continue;
        SimplexKey use = key_of(tetrahedron.corners, set);
        use[2] = tetrahedron.label;
        bool is_new = false;
        label_uses_.find_or_add(use, &is_new);
        std::uint8_t& labels = simplices_[places[set]].note.labels;
        if (is_new && labels < kManyLabels) ++labels;
    }
}

void TetrahedronMesher::finalize_before(std::uint32_t rank) {
    for (; finalized_ranks_ < rank; ++finalized_ranks_) {
        // Caps need the vertices of edges and nodes, so these are finalized after the triangles.
        simplices_.for_lowest(finalized_ranks_, [&](std::uint32_t place) {
            if (is_triangle(simplices_[place].corners)) finalize_triangle(place);
        });
        if (has_cell_labels_) count_boundary(finalized_ranks_);
        simplices_.for_lowest(finalized_ranks_, [&](std::uint32_t place) { finish(place); });
        simplices_.drop(finalized_ranks_);
    }
}

void TetrahedronMesher::finalize_triangle(std::uint32_t place) {
    if (simplices_[place].note.seen > 1) return;
    const SimplexKey key = simplices_[place].corners;
    simplices_[place].note.is_on_hull = true;
    if (sides_of(key) == 0) hull_is_box_ = false;
    for (int n = 0; n < 3; ++n) {
        simplices_[place_of({key[n], kNoRank, kNoRank})].note.is_on_hull = true;
        const std::uint32_t low = key[n == 2 ? 1 : 0], high = key[n == 0 ? 1 : 2];
        simplices_[place_of({low, high, kNoRank})].note.is_on_hull = true;
    }
    if (has_cell_labels_) ++euler(simplices_[place].note.label);
    if (options_.cap) cap(place, key);
}

/// The faces between the exterior and the regions at a triangle on the hull.
void TetrahedronMesher::cap(std::uint32_t place, const SimplexKey& key) {
    const bool turn = !simplices_[place].note.is_outward;
    const std::array<std::uint32_t, 4> corners{key[0], key[turn ? 2 : 1], key[turn ? 1 : 2], kNoRank};
    const SideSet sides = sides_of(key);
    const Label outside = sides ? exterior(std::countr_zero(sides)) : exterior(kHull);
    if (has_cell_labels_) {
        const Label inside = simplices_[place].note.label;
        if (!options_.is_background(inside)) add_face({corners[0], corners[1], corners[2]}, inside, outside);
        return;
    }
    const auto sorted_key = [&](CornerSet set) {
        SimplexKey sorted = key_of(corners, set);
        std::sort(sorted.begin(), sorted.end());
        return sorted;
    };
    const auto vertex_at = [&](CornerSet set) { return vertex(place_of(sorted_key(set))); };
    const auto middle_of = [&](CornerSet set) { return centroid(corners_of(sorted_key(set))); };
    std::array<Label, 3> label;
    for (int n = 0; n < 3; ++n) label[n] = points_.labels[corners[n]];
    for (const CasePatch& patch : triangle_patches_[triangle_pattern(label[0], label[1], label[2])])
        if (!options_.is_background(label[patch.first]))
            add_patch(patch, false, {label[patch.first], outside}, vertex_at, middle_of);
}

/// Nodes and edges that a label shares with others, or that lie on the hull, are on its boundary.
void TetrahedronMesher::count_boundary(std::uint32_t rank) {
    label_uses_.for_lowest(rank, [&](std::uint32_t use) {
        const auto [low, high, label] = label_uses_[use].corners;
        const Note& note = simplices_[place_of({low, high, kNoRank})].note;
        if (note.labels > 1 || note.is_on_hull) euler(label) += high == kNoRank ? 1 : -1;
    });
    label_uses_.drop(rank);
    const SimplexKey key{rank, kNoRank, kNoRank};
    const Note& node = simplices_[place_of(key)].note;
    if (node.labels == 4 && !node.is_on_hull) ++quadruple_points_;
    const int sides = std::popcount(sides_of(corners_of(key)));
    if (sides > 1 && node.labels + sides > kMostLabels) hull_is_box_ = false;
}

void TetrahedronMesher::finish(std::uint32_t place) {
    const Note& note = simplices_[place].note;
    if (note.vertex != kNoRank) finalized_.push_back({note.vertex, note.last_strip, note.is_on_hull, note.is_shared});
}

/// The vertex of a node, an edge or a triangle, which is used by a face of the strip.
std::uint32_t TetrahedronMesher::vertex(std::uint32_t place) {
    auto& simplex = simplices_[place];
    if (simplex.note.vertex == kNoRank) simplex.note.vertex = make_vertex(corners_of(simplex.corners));
    simplex.note.is_shared |= simplex.note.vertex < made_.first_vertex;
    simplex.note.last_strip = strip_;
    return simplex.note.vertex;
}

/// The vertex of a tetrahedron with four labels.
std::uint32_t TetrahedronMesher::inner_vertex(const RankedTetrahedron& tetrahedron) {
    const std::uint32_t number = make_vertex(tetrahedron.corners);
    finalized_.push_back({.vertex = number, .last_strip = strip_, .is_on_hull = false, .is_shared = false});
    return number;
}

std::uint32_t TetrahedronMesher::make_vertex(std::span<const std::uint32_t> corners) {
    if (std::uint64_t{made_.first_vertex} + made_.vertices.size() >= kMostVertices)
        throw Error(ErrorCode::kInput, "the model has more than 2^32 vertices before it is simplified; take a part");
    made_.vertices.push_back({centroid(corners), sides_of(corners)});
    return made_.first_vertex + static_cast<std::uint32_t>(made_.vertices.size()) - 1;
}

/// Summed relative to the first corner, so that positions far from the origin lose no precision.
Vec3 TetrahedronMesher::centroid(std::span<const std::uint32_t> corners) const {
    const Vec3 first = points_.positions[corners[0]];
    Vec3 sum;
    for (std::uint32_t rank : corners.subspan(1)) sum += points_.positions[rank] - first;
    return first + sum / static_cast<double>(corners.size());
}

/// Sides of the box on which all corners lie.
SideSet TetrahedronMesher::sides_of(std::span<const std::uint32_t> corners) const {
    SideSet sides = 0b111111;
    for (std::uint32_t rank : corners)
        for (int axis = 0; axis < 3; ++axis) {
            const double at = points_.positions[rank][axis];
            if (at != points_.box.low[axis]) sides &= static_cast<SideSet>(~(1u << 2 * axis));
            if (at != points_.box.high[axis]) sides &= static_cast<SideSet>(~(2u << 2 * axis));
        }
    return sides;
}

std::int64_t& TetrahedronMesher::euler(Label label) {
    if (label >= euler_.size()) euler_.resize(label + 1, 0);
    return euler_[label];
}

}  // namespace regionmesh
