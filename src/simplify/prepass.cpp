#include "simplify/prepass.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/parallel_for.h"
#include "base/triangle.h"
#include "mesh/strata.h"
#include "simplify/tuning.h"
#include "simplify/verdict/quality.h"
#include "simplify/verdict/verdicts.h"

namespace regionmesh {

Prepass::Prepass(Mesh& mesh, Placement& placement, Collapse& collapse, const SimplifyOptions& options, double max_cost)
    : mesh_(mesh),
      placement_(placement),
      collapse_(collapse),
      options_(options),
      max_cost_(max_cost),
      marks_(mesh.vertex_end()) {}

std::uint32_t Prepass::sweep(VerdictCounts& verdicts) {
    marks_.begin_sweep();
    std::uint32_t removed = 0;
    for (std::uint32_t v = 0; v < mesh_.vertex_end(); ++v) {
        if (options_.on_progress && (v & 0x3FFF) == 0) options_.on_progress(mesh_.face_count());
        if (!may_go(VertexId{v})) continue;
        if (try_to_remove(VertexId{v}, verdicts))
            ++removed;
        else
            marks_.settle(VertexId{v});
    }
    return removed;
}

bool Prepass::may_go(VertexId v) const {
    if (!marks_.is_due(v)) return false;
    const Vertex& vertex = mesh_[v];
    return vertex.is_alive && !vertex.is_fixed && vertex.label_count <= 3;
}

void Prepass::find(Fault fault, std::uint32_t threads) {
    constexpr std::uint32_t kFaces = 4096;  // of a task
    faulty_.clear();
    const auto find = [&](std::uint32_t first, std::uint32_t end) {
        std::vector<FaceId> faulty;
        for (std::uint32_t f = first; f < end; ++f)
            if (mesh_.is_alive(FaceId{f}) && has_fault(fault, FaceId{f})) faulty.push_back(FaceId{f});
        return faulty;
    };
    for_chunks(mesh_.face_end(), kFaces, threads, find,
               [&](const std::vector<FaceId>& faulty) { faulty_.insert(faulty_.end(), faulty.begin(), faulty.end()); });
}

bool Prepass::has_fault(Fault fault, FaceId f) const { return fault == Fault::kSliver ? is_sliver(f) : is_fold(f); }

bool Prepass::is_sliver(FaceId f) const {
    const double bound = collapse_.bounds.min_quality;
    const auto p = mesh_.corners(f);
    return !quality_is_surely_above(bound, p[0], p[1], p[2]) &&
           quality_terms(p[0], p[1], p[2]).cube() < bound * bound * bound;
}

bool Prepass::is_fold(FaceId f) const {
    const Face& face = mesh_[f];
    const auto is_on_line = [&](VertexId v) { return mesh_[v].label_count > 2; };
    if (std::none_of(face.vertices.begin(), face.vertices.end(), is_on_line)) return false;
    const auto p = mesh_.corners(f);
    const Vec3 normal = area_vector(p[0], p[1], p[2]);
    const double size2 = length2(normal);
    const auto is_turned_against = [&](FaceId g) {
        if (!mesh_[g].has_labels(face.labels)) return false;
        const auto q = mesh_.corners(g);
        const Vec3 across = area_vector(q[0], q[1], q[2]);
        const double product = dot(normal, across), across2 = length2(across);
        return product < 0 && product * product > kFoldCosine * kFoldCosine * size2 * across2 && size2 <= across2;
    };
    const auto& [a, b, c] = face.vertices;
    bool is_fold = false;
    mesh_.for_star(a, [&](FaceId g, int at) {
        const auto& other = mesh_[g].vertices;
        const bool shares_edge = (other[place_before(at)] == b) | (other[place_after(at)] == c);
        is_fold |= shares_edge && is_turned_against(g);
    });
    mesh_.for_star(
        b, [&](FaceId g, int at) { is_fold |= mesh_[g].vertices[place_before(at)] == c && is_turned_against(g); });
    return is_fold;
}

std::uint32_t Prepass::remove(Fault fault, VerdictCounts& verdicts) {
    marks_.begin_sweep();
    const double share = fault == Fault::kSliver ? kSliverShare : kFoldShare;
    const double max_cost = std::exchange(max_cost_, std::min(options_.max_cost, share * max_cost_));
    std::uint32_t removed = 0;
    for (const FaceId f : faulty_) {
        if (mesh_.face_count() <= options_.target_faces) break;
        if (!mesh_.is_alive(f) || !has_fault(fault, f)) continue;
        for (VertexId v : mesh_[f].vertices) {
            if (!may_go(v)) continue;
            if (try_to_remove(v, verdicts)) {
                ++removed;
                break;
            }
            marks_.settle(v);
        }
    }
    max_cost_ = max_cost;
    return removed;
}

bool Prepass::try_to_remove(VertexId v, VerdictCounts& verdicts) {
    find_targets(v);
    std::sort(targets_.begin(), targets_.end(), [](const Target& a, const Target& b) {
        return a.worst_quality3 != b.worst_quality3 ? a.worst_quality3 > b.worst_quality3 : a.vertex < b.vertex;
    });
    for (std::size_t n = 0; n < std::min(targets_.size(), kPrepassAttempts); ++n) {
        const Verdict verdict = test(targets_[n].vertex);
        ++verdicts[static_cast<int>(verdict)];
        if (verdict != Verdict::kAccepted) continue;
        apply(targets_[n].vertex);
        return true;
    }
    return false;
}

/// Neighbours that pass the cheap tests: strata, cost, fold and quality.
void Prepass::find_targets(VertexId v) {
    targets_.clear();
    if (!gather_ends(v)) return;
    const std::span<const VertexId> ends(ends_.data(), end_count_);
    placement_.rank_halves(mesh_, v, ends, costs_);
    const auto is_cheap = [&](const HalfCost& cost) { return cost.is_within(max_cost_, options_.max_error); };
    if (std::none_of(costs_.begin(), costs_.end(), is_cheap)) return;
    gather_vertex(mesh_, v, around_);
    for (std::size_t n = 0; n < ends.size(); ++n) {
        if (!is_cheap(costs_[n])) continue;
        const double quality3 = fan_quality3(mesh_, around_, ends[n], mesh_.position(ends[n]), collapse_.bounds);
        if (quality3 > 0) targets_.push_back({ends[n], quality3});
    }
}

/// False where the vertex has more faces than the prepass looks at.
bool Prepass::gather_ends(VertexId v) {
    end_count_ = 0;
    line_ends_.clear();
    int faces = 0;
    mesh_.for_star(v, [&](FaceId f, int place) {
        ++faces;
        const auto& corners = mesh_[f].vertices;
        const VertexId after = corners[place_after(place)], before = corners[place_before(place)];
        if (mesh_[v].label_count == 2) return add_end(after);  // each neighbour comes first in one face
        for (VertexId end : {after, before}) {
            if (mesh_[end].label_count < 3 || std::find(line_ends_.begin(), line_ends_.end(), end) != line_ends_.end())
                continue;
            line_ends_.push_back(end);
            if (edge_labels(mesh_, v, end).size() == mesh_[v].label_count) add_end(end);
        }
    });
    return faces <= kMostPrepassFaces;
}

/// Without a branch, which would be mispredicted.
void Prepass::add_end(VertexId end) {
    const bool may_stay = !mesh_[end].is_fixed & !marks_.is_touched(end);
    ends_[end_count_] = end;
    end_count_ += may_stay & (end_count_ < kMostPrepassFaces);
}

Verdict Prepass::test(VertexId target) {
    gather_half(mesh_, around_.goes, target, collapse_.star);
    return examine(collapse_, [&] { return Places{collapse_.star.at_stays}; });
}

void Prepass::apply(VertexId target) {
    const EdgeStar& star = collapse_.star;
    placement_.collapse(mesh_, star, star.at_stays);
    collapse_edge(mesh_, collapse_);
    marks_.touch(target);
    for (VertexId v : star.link) marks_.touch(v);
}

}  // namespace regionmesh
