#include "regionmesh/decimate/candidates.h"

#include <algorithm>
#include <cmath>

#include "regionmesh/base/hash.h"
#include "regionmesh/base/triangle.h"
#include "regionmesh/model/strata.h"

namespace regionmesh {
namespace {

/// Weight of the planes along lines, against that of faces with an edge of the same length.
constexpr double kLineWeight = 1;
constexpr float kNoFloor = -std::numeric_limits<float>::infinity();

}  // namespace

Candidates::Candidates(Model& model, const DecimateOptions& options)
    : model_(model), options_(options), heap_(model.vertex_end()) {
    const std::uint32_t end = model.vertex_end();
    quadrics_.resize(end);
    partner_.resize(end, kNoVertex);
    floor_.resize(end, kNoFloor);
    count_labels();
    gather_quadrics();
}

std::size_t Candidates::bytes() const { return quadrics_.bytes() + partner_.bytes() + floor_.bytes() + heap_.bytes(); }

void Candidates::count_labels() {
    for (std::uint32_t v = 0; v < model_.vertex_end(); ++v)
        if (model_.is_alive(VertexId{v}))
            model_[VertexId{v}].label_count = static_cast<std::uint8_t>(vertex_labels(model_, VertexId{v}).size());
}

void Candidates::add_to_quadric(VertexId v, const Quadric& q) {
    Quadric sum = quadrics_[index(v)].unpack();
    sum += q;
    quadrics_[index(v)] = PackedQuadric(sum);
}

void Candidates::gather_quadrics() {
    for (std::uint32_t f = 0; f < model_.face_end(); ++f) {
        if (!model_.is_alive(FaceId{f})) continue;
        const Face& face = model_[FaceId{f}];
        const auto p = model_.corners(FaceId{f});
        const Vec3 area = area_vector(p[0], p[1], p[2]);
        const double twice = length(area);
        if (!(twice > 0)) continue;
        const Vec3 normal = area / twice;
        Quadric plane;  // through each corner: no offset, relative to it
        plane.add_plane(normal, 0, twice / 6);
        for (VertexId v : face.vertices) add_to_quadric(v, plane);
        for (int n = 0; n < 3; ++n) {
            const VertexId a = face.vertices[n], b = face.vertices[(n + 1) % 3];
            if (label_count(a) < 3 || label_count(b) < 3 || edge_labels(model_, a, b).size() < 3) continue;
            const Vec3 along = p[(n + 1) % 3] - p[n];
            Quadric upright;
            upright.add_plane(cross(along, normal) / length(along), 0, kLineWeight * length2(along) / 2);
            add_to_quadric(a, upright);
            add_to_quadric(b, upright);
        }
    }
}

std::uint64_t Candidates::refresh() {
    std::uint64_t forbidden = 0;
    for (std::uint32_t v = 0; v < model_.vertex_end(); ++v) {
        floor_[v] = kNoFloor;
        if (model_.is_alive(VertexId{v}))
            rank(VertexId{v}, best(VertexId{v}, {kNoVertex, kNoFloor}, kNoVertex, &forbidden));
    }
    return forbidden;
}

/// The edges of v with their numbers of labels and their costs. Round a vertex of two labels all edges have both, and
/// each neighbour follows v in exactly one face.
void Candidates::gather_neighbours(VertexId v, Neighbours& found) {
    found.vertices.clear();
    if (label_count(v) == 2) {
        model_.for_star(v, [&](FaceId f, int place) {
            found.vertices.push_back(model_[f].vertices[place == 2 ? 0 : place + 1]);
        });
        found.label_counts.assign(found.vertices.size(), 2);
    } else {
        count_edge_labels(v, found);
    }
    find_edge_costs(model_, quadrics_, v, found.vertices, found.costs);
}

void Candidates::count_edge_labels(VertexId v, Neighbours& found) {
    edge_labels_.clear();
    model_.for_star(v, [&](FaceId f, int place) {
        const Face& face = model_[f];
        for (VertexId n : {face.vertices[(place + 1) % 3], face.vertices[(place + 2) % 3]}) {
            const auto at = std::find(found.vertices.begin(), found.vertices.end(), n) - found.vertices.begin();
            if (at == static_cast<std::ptrdiff_t>(found.vertices.size())) {
                found.vertices.push_back(n);
                edge_labels_.emplace_back();
            }
            for (Label label : face.labels) edge_labels_[at].labels.add(label);
            edge_labels_[at].uses += 2;
        }
    });
    found.label_counts.clear();
    for (std::size_t n = 0; n < found.vertices.size(); ++n) {
        // Where the surface ends sides count, too.
        const auto& [labels, uses] = edge_labels_[n];
        const int count = uses >= 2 * labels.size() ? labels.size() : edge_labels(model_, v, found.vertices[n]).size();
        found.label_counts.push_back(static_cast<std::uint8_t>(count));
    }
}

/// The end that would go, or none.
VertexId Candidates::owner(VertexId a, VertexId b, int count) const {
    const bool a_may = label_count(a) == count, b_may = label_count(b) == count;
    if (a_may && b_may) return ((index(a) ^ index(b)) & 1) != 0 ? std::min(a, b) : std::max(a, b);
    return a_may ? a : b_may ? b : kNoVertex;
}

EdgeEnds Candidates::ends(VertexId goes, VertexId stays) const {
    return {model_.position(goes), model_.position(stays), quadrics_[index(goes)], quadrics_[index(stays)],
            model_[stays].sides};
}

/// Rank of an edge; infinite beyond the cost level or the largest error.
float Candidates::key(VertexId goes, VertexId stays, EdgeCost edge) const {
    constexpr float kNever = std::numeric_limits<float>::infinity();
    if (!(edge.cost <= options_.max_cost)) return kNever;
    if (std::isfinite(options_.max_error) && edge.cost > options_.max_error * options_.max_error * edge.weight)
        return kNever;
    const double scale2 = options_.scale * options_.scale;
    return static_cast<float>(edge.rank + options_.perturbation * scale2 * scale2 * hash_unit(index(goes), index(stays)));
}

/// The cheapest edge owned by v that comes after `after`, or leads to `fresh`.
Candidates::Best Candidates::best(VertexId v, Best after, VertexId fresh, std::uint64_t* forbidden) {
    Best best{kNoVertex, std::numeric_limits<float>::infinity()};
    if (model_[v].is_fixed) return best;
    gather_neighbours(v, neighbours_);
    for (std::size_t n = 0; n < neighbours_.vertices.size(); ++n) {
        const VertexId w = neighbours_.vertices[n];
        if (model_[w].is_fixed) continue;
        const VertexId goes = owner(v, w, neighbours_.label_counts[n]);
        if (forbidden && goes == kNoVertex && v < w) ++*forbidden;
        if (goes != v) continue;
        const Best candidate{w, key(v, w, neighbours_.costs[n])};
        if (candidate.is_before(best) && (w == fresh || after.is_before(candidate))) best = candidate;
    }
    if (std::isinf(best.key)) best.stays = kNoVertex;
    return best;
}

void Candidates::rank(VertexId v, Best best) {
    partner_[index(v)] = best.stays;
    if (best.stays == kNoVertex)
        heap_.remove(v);
    else
        heap_.set(v, best.key);
}

void Candidates::refuse() {
    const VertexId v = heap_.top();
    const Best refused{partner_[index(v)], heap_.top_key()};
    floor_[index(v)] = std::max(floor_[index(v)], refused.key);
    rank(v, best(v, refused, kNoVertex, nullptr));
}

void Candidates::merge(VertexId goes, VertexId stays, Vec3 position) {
    quadrics_[index(stays)] = PackedQuadric(merged_quadric(ends(goes, stays), position));
    heap_.remove(goes);
    partner_[index(goes)] = kNoVertex;
}

void Candidates::update(VertexId goes, VertexId stays) {
    gather_neighbours(stays, round_merged_);
    Best own{kNoVertex, std::numeric_limits<float>::infinity()};
    for (std::size_t n = 0; n < round_merged_.vertices.size(); ++n) {
        const VertexId w = round_merged_.vertices[n];
        if (model_[w].is_fixed) continue;
        const VertexId owner_of_edge = owner(stays, w, round_merged_.label_counts[n]);
        if (owner_of_edge == stays) {
            const Best candidate{w, key(stays, w, round_merged_.costs[n])};
            if (candidate.is_before(own)) own = candidate;
        }
        const VertexId held = partner_[index(w)];
        if (held == goes || held == stays) {
            rank(w, best(w, {kNoVertex, floor_[index(w)]}, stays, nullptr));
        } else if (owner_of_edge == w) {
            const Best fresh{stays, key(w, stays, round_merged_.costs[n])};
            if (std::isfinite(fresh.key) && (held == kNoVertex || fresh.is_before({held, heap_.key(w)})))
                rank(w, fresh);
        }
    }
    floor_[index(stays)] = kNoFloor;
    if (std::isinf(own.key)) own.stays = kNoVertex;
    rank(stays, own);
}

}  // namespace regionmesh
