#include "simplify/thinning.h"

#include <algorithm>
#include <cmath>

#include "mesh/strata.h"
#include "simplify/collapse.h"

namespace regionmesh {
namespace {

/// Nothing near the vertex has changed since it could not be removed.
constexpr std::uint8_t kSettled = 255;

/// Vertices with more faces are left to the ranking.
constexpr int kMostFaces = 16;

/// Targets that are tried.
constexpr std::size_t kAttempts = 2;

}  // namespace

Thinning::Thinning(Mesh& mesh, FaceTree& tree, VertexQuadrics& quadrics, const DecimateOptions& options,
                   const ShapeBounds& bounds, double max_cost)
    : mesh_(mesh),
      tree_(tree),
      quadrics_(quadrics),
      options_(options),
      bounds_(bounds),
      max_cost_(max_cost),
      seen_(mesh.vertex_end(), 0) {}

std::uint32_t Thinning::sweep(VerdictCounts& verdicts) {
    ++sweep_;
    std::uint32_t removed = 0;
    for (std::uint32_t v = 0; v < mesh_.vertex_end(); ++v) {
        if (options_.on_progress && (v & 0x3FFF) == 0) options_.on_progress();
        const Vertex& vertex = mesh_[VertexId{v}];
        if (!vertex.is_alive || vertex.is_fixed || vertex.label_count > 3) continue;
        if (seen_[v] == kSettled || seen_[v] == sweep_) continue;
        if (try_to_remove(VertexId{v}, verdicts))
            ++removed;
        else
            seen_[v] = kSettled;
    }
    return removed;
}

bool Thinning::try_to_remove(VertexId v, VerdictCounts& verdicts) {
    find_targets(v);
    std::sort(targets_.begin(), targets_.end(), [](const Target& a, const Target& b) {
        return a.worst_quality3 != b.worst_quality3 ? a.worst_quality3 > b.worst_quality3 : a.vertex < b.vertex;
    });
    for (std::size_t n = 0; n < std::min(targets_.size(), kAttempts); ++n) {
        const Verdict verdict = examine(targets_[n].vertex);
        ++verdicts[static_cast<int>(verdict)];
        if (verdict != Verdict::kAccepted) continue;
        collapse(targets_[n].vertex);
        return true;
    }
    return false;
}

/// Neighbours that the vertex may go to as far as strata, cost, fold and quality tell.
void Thinning::find_targets(VertexId v) {
    targets_.clear();
    gather_vertex(mesh_, v, around_);
    if (around_.face_count() > kMostFaces) return;
    const Quadric own = quadrics_[v].unpack();
    if (mesh_[v].label_count == 2) {
        for (const StarFace& face : around_.faces) add_target(own, face.a);
        return;
    }
    ends_.clear();
    for (const StarFace& face : around_.faces) {
        for (VertexId end : {face.a, face.b}) {
            if (mesh_[end].label_count < 3 || std::find(ends_.begin(), ends_.end(), end) != ends_.end()) continue;
            ends_.push_back(end);
            if (edge_labels(mesh_, v, end).size() == mesh_[v].label_count) add_target(own, end);
        }
    }
}

void Thinning::add_target(const Quadric& own, VertexId target) {
    if (mesh_[target].is_fixed || seen_[index(target)] == sweep_) return;
    const PackedQuadric& other = quadrics_[target];
    const double cost = own.at(mesh_.position(target) - around_.at_goes) + other.c;
    if (!(cost <= max_cost_)) return;
    const double weight = own.weight() + other.xx + other.yy + other.zz;
    if (cost > options_.max_error * options_.max_error * weight) return;
    const double quality3 = fan_quality3(around_, target, mesh_.position(target), bounds_);
    if (quality3 > 0) targets_.push_back({target, quality3});
}

Verdict Thinning::examine(VertexId target) {
    gather_half(mesh_, around_.goes, target, star_);
    const Verdict topology = half_topology_verdict(mesh_, star_);
    if (topology != Verdict::kAccepted) return topology;
    const ShapeResult shape = shape_verdict(star_, star_.at_stays, bounds_);
    if (shape.verdict != Verdict::kAccepted) return shape.verdict;
    if (options_.intersect_check) return obstruction_.verdict(mesh_, tree_, star_, star_.at_stays, bounds_);
    return pinches_around(mesh_, star_, star_.at_stays, bounds_) ? Verdict::kPinch : Verdict::kAccepted;
}

void Thinning::collapse(VertexId target) {
    quadrics_.merge(mesh_, star_.goes, target, star_.at_stays);
    collapse_edge(mesh_, tree_, star_, star_.at_stays);
    seen_[index(target)] = sweep_;
    for (VertexId v : star_.link) seen_[index(v)] = sweep_;
}

}  // namespace regionmesh
