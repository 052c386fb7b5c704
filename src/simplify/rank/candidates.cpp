#include "simplify/rank/candidates.h"

#include <algorithm>
#include <cmath>

#include "base/hash.h"
#include "base/parallel_for.h"
#include "mesh/strata.h"

namespace regionmesh {
namespace {

constexpr float kNoFloor = -std::numeric_limits<float>::infinity();

}  // namespace

Candidates::Candidates(const Mesh& mesh, Placement& placement, const SimplifyOptions& options, EdgeOrder order)
    : mesh_(mesh),
      placement_(placement),
      options_(options),
      queue_(mesh.vertex_end(), order),
      key_unit_(std::ldexp(1.0, -4 * std::ilogb(options.promises.scale))) {
    partner_.resize(mesh.vertex_end(), kNoVertex);
    floor_.resize(mesh.vertex_end(), kNoFloor);
}

std::size_t Candidates::bytes() const { return partner_.bytes() + floor_.bytes() + queue_.bytes(); }

std::uint64_t Candidates::refresh(std::uint32_t threads) {
    constexpr std::uint32_t kVertices = 1024;  // of a task
    struct Part {
        std::vector<Best> best;  // by vertex
        Notes notes;
    };
    const auto find = [&](std::uint32_t first, std::uint32_t end) {
        Part part;
        part.best.resize(end - first);
        Scratch scratch;
        for (std::uint32_t v = first; v < end; ++v)
            if (mesh_.is_alive(VertexId{v}))
                part.best[v - first] = best(VertexId{v}, {kNoVertex, kNoFloor}, kNoVertex, scratch);
        part.notes = scratch.notes;
        return part;
    };
    std::uint32_t v = 0;
    std::uint64_t forbidden = 0;
    has_edges_over_error_ = false;
    for_chunks(mesh_.vertex_end(), kVertices, placement_.ranks_in_parallel() ? threads : 1, find, [&](Part part) {
        for (const Best& best : part.best) {
            floor_[v] = kNoFloor;
            enqueue(VertexId{v++}, best);
        }
        forbidden += part.notes.forbidden;
        note(part.notes);
    });
    return forbidden;
}

/// The number of labels of an edge: two where an end has no more.
int Candidates::edge_label_count(VertexId v, VertexId w) const {
    return label_count(v) == 2 || label_count(w) == 2 ? 2 : edge_labels(mesh_, v, w).size();
}

/// Calls visit(w) for each neighbour of v. Round a vertex of two labels each neighbour follows v in exactly one face.
template <class Visit>
void Candidates::for_neighbours(VertexId v, std::vector<VertexId>& seen, Visit&& visit) const {
    seen.clear();
    mesh_.for_star(v, [&](FaceId f, int place) {
        const Face& face = mesh_[f];
        const VertexId after = face.vertices[place_after(place)], before = face.vertices[place_before(place)];
        if (label_count(v) == 2) return visit(after);
        for (VertexId w : {after, before}) {
            if (std::find(seen.begin(), seen.end(), w) != seen.end()) continue;
            seen.push_back(w);
            visit(w);
        }
    });
}

/// The end that would go, or none.
VertexId Candidates::owner(VertexId a, VertexId b, int count) const {
    const bool a_may = label_count(a) == count, b_may = label_count(b) == count;
    const bool a_first = (a < b) == (((index(a) ^ index(b)) & 1) != 0);  // where both may
    const std::uint32_t is_a = a_may & (a_first | !b_may);
    const VertexId one{index(b) ^ ((index(a) ^ index(b)) & -is_a)};  // no branch: it is as good as random
    return a_may | b_may ? one : kNoVertex;
}

bool Candidates::may_go(VertexId v, VertexId w) const {
    if (mesh_[v].is_fixed || mesh_[w].is_fixed) return false;
    const LabelSet labels = edge_labels(mesh_, v, w);
    return labels.size() > 0 && labels.size() == label_count(v);
}

/// Rank of an edge; infinite above the threshold or the largest error.
float Candidates::key(VertexId goes, VertexId stays, EdgeCost edge, Scratch& scratch) const {
    constexpr float kNever = std::numeric_limits<float>::infinity();
    if (!(edge.cost <= options_.max_cost)) return kNever;
    if (std::isfinite(options_.promises.max_error) &&
        edge.cost > options_.promises.max_error * options_.promises.max_error * edge.weight) {
        scratch.notes.has_edges_over_error = true;
        return kNever;
    }
    const double scale2 = options_.promises.scale * options_.promises.scale;
    return static_cast<float>(
        key_unit_ * (edge.rank + options_.perturbation * scale2 * scale2 * hash_unit(index(goes), index(stays))));
}

/// The cheapest edge owned by v that comes after `after`, or leads to `fresh`.
Candidates::Best Candidates::best(VertexId v, Best after, VertexId fresh, Scratch& scratch) const {
    Best best{kNoVertex, std::numeric_limits<float>::infinity()};
    if (mesh_[v].is_fixed) return best;
    std::size_t count = 0;
    for_neighbours(v, scratch.seen, [&](VertexId w) {
        if (mesh_[w].is_fixed) return;
        const VertexId goes = owner(v, w, edge_label_count(v, w));
        scratch.notes.forbidden += (goes == kNoVertex) & (v < w);
        // Whether v owns the edge is as good as random: no branch.
        if (scratch.owned.size() == count) scratch.owned.resize(2 * count + 16);
        scratch.owned[count] = w;
        count += goes == v;
    });
    const std::span<const VertexId> owned(scratch.owned.data(), count);
    placement_.rank(mesh_, v, owned, scratch.costs);
    for (std::size_t n = 0; n < count; ++n) {
        const Best candidate{owned[n], key(v, owned[n], scratch.costs[n], scratch)};
        const bool is_next = (owned[n] == fresh) | after.is_before(candidate);
        if (candidate.is_before(best) & is_next) best = candidate;
    }
    if (std::isinf(best.key)) best.stays = kNoVertex;
    return best;
}

void Candidates::enqueue(VertexId v, Best best) {
    partner_[index(v)] = best.stays;
    if (best.stays == kNoVertex)
        queue_.remove(v);
    else
        queue_.set(v, best.key);
}

void Candidates::refuse(VertexId goes, Best after) {
    float& floor = floor_[index(goes)];
    floor = std::max(floor, queue_.key(goes));
    enqueue(goes, after);
}

void Candidates::rank_around(VertexId goes, VertexId stays, Scratch& scratch, std::vector<Ranked>& ranked) const {
    ranked.clear();
    std::vector<VertexId>& around = scratch.around;
    around.clear();
    for_neighbours(stays, scratch.seen, [&](VertexId w) { around.push_back(w); });
    placement_.rank(mesh_, stays, around, scratch.costs_around);
    Best own{kNoVertex, std::numeric_limits<float>::infinity()};
    for (std::size_t n = 0; n < around.size(); ++n) {
        const VertexId w = around[n];
        if (mesh_[w].is_fixed) continue;
        const EdgeCost cost = scratch.costs_around[n];
        const VertexId owner_of_edge = owner(stays, w, edge_label_count(stays, w));
        if (owner_of_edge == stays) {
            const Best candidate{w, key(stays, w, cost, scratch)};
            if (candidate.is_before(own)) own = candidate;
        }
        const VertexId held = partner_[index(w)];
        if (held == goes || held == stays) {
            ranked.push_back({w, best(w, {kNoVertex, floor_[index(w)]}, stays, scratch)});
        } else if (owner_of_edge == w) {
            const Best fresh{stays, key(w, stays, cost, scratch)};
            if (std::isfinite(fresh.key) && (held == kNoVertex || fresh.is_before({held, queue_.key(w)})))
                ranked.push_back({w, fresh});
        }
    }
    if (std::isinf(own.key)) own.stays = kNoVertex;
    ranked.push_back({stays, own});
}

void Candidates::update(VertexId goes, VertexId stays, std::span<const Ranked> ranked) {
    queue_.remove(goes);
    partner_[index(goes)] = kNoVertex;
    floor_[index(stays)] = kNoFloor;
    for (const Ranked& own : ranked) enqueue(own.goes, own.best);
}

}  // namespace regionmesh
