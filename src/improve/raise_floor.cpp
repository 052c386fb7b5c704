#include <algorithm>
#include <array>
#include <cmath>

#include "base/triangle.h"
#include "improve/edge_flips.h"
#include "improve/edge_splits.h"
#include "improve/short_edges.h"
#include "improve/vertex_moves.h"
#include "judge/error_bound.h"
#include "mesh/strata.h"
#include "regionmesh/box_axes.h"
#include "regionmesh/improve.h"

namespace regionmesh {
namespace {

/// Most rounds over the faces below the bound. Later ones find what earlier ones made curable.
constexpr std::uint32_t kMostRounds = 12;

/// Share of the scale by which the surface may move round these faces (SurfaceDrift::kPoorShare times this).
constexpr double kTolerance = 0.1;

double quality_of(const Mesh& mesh, FaceId f) {
    const auto p = mesh.corners(f);
    return face_quality(p[0], p[1], p[2]);
}

class FloorLoop {
public:
    FloorLoop(Mesh& mesh, const Promises& promises, double bound)
        : mesh_(mesh),
          bound_(bound),
          kept_(kept_of(mesh, promises)),
          judge_(mesh, kept_),
          drift_(mesh.vertex_end(), kTolerance * kept_.scale),
          flips_(judge_, drift_, bound),
          moves_(judge_, drift_, bound),
          short_edges_(judge_, drift_),
          splits_(judge_, drift_),
          changed_(mesh.vertex_end(), 0) {}

    void run(std::vector<FaceId> low, FloorResult& result) {
        for (round_ = 1; round_ <= kMostRounds && !low.empty(); ++round_) {
            std::uint64_t cures = 0;
            for (const FaceId f : low)
                if (mesh_.is_alive(f) && is_due(f) && quality_of(mesh_, f) < bound_) cures += cure(f, result);
            if (cures == 0) return;
            low = faces_below(mesh_, bound_);
        }
    }

    static std::vector<FaceId> faces_below(const Mesh& mesh, double bound) {
        std::vector<FaceId> faces;
        for (std::uint32_t f = 0; f < mesh.face_end(); ++f)
            if (mesh.is_alive(FaceId{f}) && quality_of(mesh, FaceId{f}) < bound) faces.push_back(FaceId{f});
        return faces;
    }

private:
    /// The promises, but for quality: FanShape demands more. No faces may cross, whatever the options say.
    static Promises kept_of(const Mesh& mesh, const Promises& promises) {
        Promises kept = promises;
        kept.min_quality = 0;
        kept.intersect_check = true;
        kept.max_error =
            std::min(kept.max_error, largest_error_bound(mesh) + SurfaceDrift::kPoorShare * kTolerance * kept.scale);
        return kept;
    }

    /// Has something round the face changed since it was tried?
    bool is_due(FaceId f) {
        changed_.resize(mesh_.vertex_end(), round_);
        return std::ranges::any_of(mesh_[f].vertices, [&](VertexId v) { return changed_[index(v)] + 1 >= round_; });
    }

    bool cure(FaceId f, FloorResult& result) {
        const auto corners = mesh_[f].vertices;
        if (!try_cures(f, result)) return false;
        changed_.resize(mesh_.vertex_end(), round_);
        for (const VertexId v : corners) {
            if (!mesh_.is_alive(v)) continue;
            mesh_.for_star(v, [&](FaceId g, int) {
                for (const VertexId w : mesh_[g].vertices) changed_[index(w)] = round_;
            });
        }
        return true;
    }

    bool try_cures(FaceId f, FloorResult& result) {
        if (short_edges_.try_collapse(f)) return ++result.collapses;
        for (int place = 0; place < 3; ++place)
            if (flips_.try_flip(f, place)) return ++result.flips;
        for (const VertexId v : mesh_[f].vertices)
            if (moves_.try_move(v) || moves_.try_any_direction(v)) return ++result.moves;
        if (splits_.try_split(f)) return ++result.splits;
        return false;
    }

    const Mesh& mesh_;
    double bound_;
    Promises kept_;
    Judge judge_;
    SurfaceDrift drift_;
    EdgeFlips flips_;
    VertexMoves moves_;
    ShortEdges short_edges_;
    EdgeSplits splits_;
    std::vector<std::uint32_t> changed_;  // by vertex: the last round that changed its star
    std::uint32_t round_ = 0;
};

double lowest_quality(const Mesh& mesh) {
    double lowest = mesh.face_count() == 0 ? 0 : 1;
    for (std::uint32_t f = 0; f < mesh.face_end(); ++f)
        if (mesh.is_alive(FaceId{f})) lowest = std::min(lowest, quality_of(mesh, FaceId{f}));
    return lowest;
}

}  // namespace

FloorResult raise_floor(Mesh& mesh, const Promises& promises) {
    require_in_range(promises);
    require_along_axes(mesh);
    const double bound = promises.quality_bound();
    FloorResult result;
    result.lowest_before = lowest_quality(mesh);
    std::vector<FaceId> low = FloorLoop::faces_below(mesh, bound);
    result.below_before = low.size();
    if (!low.empty()) {
        count_labels(mesh);
        FloorLoop(mesh, promises, bound).run(std::move(low), result);
        mesh.compact();
        low = FloorLoop::faces_below(mesh, bound);
    }
    result.below_after = low.size();
    result.lowest_after = lowest_quality(mesh);
    result.error_bound = largest_error_bound(mesh);
    for (std::size_t n = 0; n < std::min(low.size(), FloorResult::kMostLeft); ++n) {
        const auto p = mesh.corners(low[n]);
        result.left.push_back((p[0] + p[1] + p[2]) / 3);
    }
    return result;
}

}  // namespace regionmesh
