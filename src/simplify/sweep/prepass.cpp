#include "simplify/sweep/prepass.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/parallel_for.h"
#include "base/triangle.h"
#include "judge/try_together.h"
#include "judge/verdict/quality.h"
#include "judge/verdict/verdicts.h"
#include "mesh/strata.h"
#include "simplify/tuning.h"

namespace regionmesh {

Prepass::Prepass(Judge& judge, Placement& placement, const SimplifyOptions& options, double max_cost)
    : judge_(judge),
      mesh_(judge.mesh()),
      placement_(placement),
      options_(options),
      max_cost_(max_cost),
      marks_(mesh_.vertex_end()) {}

std::uint32_t Prepass::sweep(VerdictCounts& verdicts) {
    marks_.begin_sweep();
    attempt_.verdicts = {};
    std::uint32_t removed = 0;
    for (std::uint32_t v = 0; v < mesh_.vertex_end(); ++v) {
        if (options_.on_progress && (v & 0x3FFF) == 0) options_.on_progress(mesh_.face_count());
        if (!may_go(VertexId{v})) continue;
        test_vertex(VertexId{v}, attempt_);
        if (attempt_.is_accepted) {
            make(attempt_);
            ++removed;
        } else {
            marks_.settle(VertexId{v});
        }
    }
    add(verdicts, attempt_.verdicts);
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
    const double bound = judge_.bounds().min_quality;
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

std::uint32_t Prepass::remove(Fault fault, VerdictCounts& verdicts, bool in_stripes, std::uint32_t threads) {
    marks_.begin_sweep();
    const double share = fault == Fault::kSliver ? kSliverShare : kFoldShare;
    const double max_cost = std::exchange(max_cost_, std::min(options_.max_cost, share * max_cost_));
    std::uint32_t removed = 0;
    const auto test = [&](std::uint32_t n, Attempt& attempt) { test_face(fault, faulty_[n], attempt); };
    const auto settle = [&](std::uint32_t, Attempt& attempt) {
        if (is_at_target()) return false;
        add(verdicts, attempt.verdicts);
        for (const VertexId v : attempt.kept) marks_.settle(v);
        if (attempt.is_accepted) make(attempt);
        removed += attempt.is_accepted;
        return attempt.is_accepted;
    };
    const auto size = static_cast<std::uint32_t>(faulty_.size());
    if (in_stripes) {
        try_in_stripes(size, placement_.ranks_in_parallel() ? threads : 1, attempt_, test, settle);
    } else {
        for (std::uint32_t n = 0; n < size; ++n) {
            test(n, attempt_);
            settle(n, attempt_);
        }
    }
    max_cost_ = max_cost;
    return removed;
}

/// Its vertices one by one, until one may go.
void Prepass::test_face(Fault fault, FaceId f, Attempt& attempt) const {
    attempt.is_accepted = false;
    attempt.verdicts = {};
    attempt.kept.clear();
    attempt.box = {};
    if (is_at_target() || !mesh_.is_alive(f)) return;
    for (Vec3 p : mesh_.corners(f)) attempt.box.add(p);
    if (!has_fault(fault, f)) return;
    for (VertexId v : mesh_[f].vertices) {
        if (!may_go(v)) continue;
        test_vertex(v, attempt);
        if (attempt.is_accepted) return;
        attempt.kept.push_back(v);
    }
}

void Prepass::test_vertex(VertexId v, Attempt& attempt) const {
    attempt.is_accepted = false;
    auto& targets = attempt.targets;
    find_targets(v, attempt);
    std::sort(targets.begin(), targets.end(), [](const Target& a, const Target& b) {
        return a.worst_quality3 != b.worst_quality3 ? a.worst_quality3 > b.worst_quality3 : a.vertex < b.vertex;
    });
    for (std::size_t n = 0; n < std::min(targets.size(), kPrepassAttempts); ++n) {
        EdgeStar& star = attempt.change.star;
        gather_half(mesh_, v, targets[n].vertex, star);
        const Verdict verdict = examine(judge_, attempt.change, [&] { return Places{star.at_stays}; });
        ++attempt.verdicts[static_cast<int>(verdict)];
        attempt.is_accepted = verdict == Verdict::kAccepted;
        if (attempt.is_accepted) return;
    }
}

/// Neighbours that pass the cheap tests: strata, cost, fold and quality.
void Prepass::find_targets(VertexId v, Attempt& attempt) const {
    attempt.targets.clear();
    if (!gather_ends(v, attempt)) return;
    const std::span<const VertexId> ends(attempt.ends.data(), attempt.end_count);
    placement_.rank_halves(mesh_, v, ends, attempt.costs);
    const auto is_cheap = [&](const HalfCost& cost) { return cost.is_within(max_cost_, options_.promises.max_error); };
    if (std::none_of(attempt.costs.begin(), attempt.costs.end(), is_cheap)) return;
    gather_vertex(mesh_, v, attempt.around);
    attempt.box.add(attempt.around.link_box.low);
    attempt.box.add(attempt.around.link_box.high);
    for (std::size_t n = 0; n < ends.size(); ++n) {
        if (!is_cheap(attempt.costs[n])) continue;
        const double quality3 = fan_quality3(mesh_, attempt.around, ends[n], mesh_.position(ends[n]), judge_.bounds());
        if (quality3 > 0) attempt.targets.push_back({ends[n], quality3});
    }
}

/// False where the vertex has more faces than the prepass looks at.
bool Prepass::gather_ends(VertexId v, Attempt& attempt) const {
    std::vector<VertexId>& line_ends = attempt.line_ends;
    attempt.end_count = 0;
    line_ends.clear();
    int faces = 0;
    mesh_.for_star(v, [&](FaceId f, int place) {
        ++faces;
        const auto& corners = mesh_[f].vertices;
        const VertexId after = corners[place_after(place)], before = corners[place_before(place)];
        if (mesh_[v].label_count == 2) return add_end(after, attempt);  // each neighbour comes first in one face
        for (VertexId end : {after, before}) {
            if (mesh_[end].label_count < 3 || std::find(line_ends.begin(), line_ends.end(), end) != line_ends.end())
                continue;
            line_ends.push_back(end);
            if (edge_labels(mesh_, v, end).size() == mesh_[v].label_count) add_end(end, attempt);
        }
    });
    return faces <= kMostPrepassFaces;
}

/// Without a branch, which would be mispredicted.
void Prepass::add_end(VertexId end, Attempt& attempt) const {
    const bool may_stay = !mesh_[end].is_fixed & !marks_.is_touched(end);
    attempt.ends[attempt.end_count] = end;
    attempt.end_count += may_stay & (attempt.end_count < kMostPrepassFaces);
}

void Prepass::make(Attempt& attempt) {
    const EdgeStar& star = attempt.change.star;
    placement_.collapse(mesh_, star, star.at_stays);
    judge_.apply(attempt.change);
    marks_.touch(star.stays);
    for (VertexId v : star.link) marks_.touch(v);
}

}  // namespace regionmesh
