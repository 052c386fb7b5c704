#include "regionmesh/simplify.h"

#include <algorithm>
#include <cmath>

#include "mesh/strata.h"
#include "simplify/candidates.h"
#include "simplify/collapse.h"
#include "simplify/edge_star.h"
#include "simplify/legality.h"
#include "simplify/obstruction.h"
#include "simplify/thinning.h"

namespace regionmesh {
namespace {

/// A cost below this share of the largest that the edge could have counts as none: the star is flat.
constexpr double kFlat = 1e-9;

/// Share of the face places in use below which faces are packed and their tree is built anew.
constexpr double kCompactBelow = 0.5;

/// Vertices whose removal costs less than this, in units of scale^4, go in sweeps before the others are ranked. A sweep
/// leaves at least so much of the faces, and is the last when it takes less than so much of them.
constexpr double kThinCost = 1e-3;
constexpr double kLeastLeft = 0.65, kLeastGain = 0.02;
constexpr int kMostSweeps = 16;

class Decimation {
public:
    Decimation(Mesh& mesh, const DecimateOptions& options)
        : mesh_(mesh),
          options_(options),
          tree_(mesh),
          beyond_(fix_beyond(mesh, options.limits)),
          quadrics_((count_labels(mesh), mesh)),
          candidates_(mesh, quadrics_, options) {
        bounds_.min_quality = options.min_quality;
    }
    ~Decimation() {
        for (VertexId v : beyond_) mesh_[v].is_fixed = false;
    }
    Decimation(const Decimation&) = delete;
    Decimation& operator=(const Decimation&) = delete;

    DecimateResult run() {
        thin();
        for (;;) {
            if (mesh_.face_count() <= options_.target_faces) break;
            result_.verdicts[static_cast<int>(Verdict::kStrata)] += candidates_.refresh();
            result_.bytes = tree_.bytes() + candidates_.bytes();
            const std::uint64_t before = count(Verdict::kAccepted);
            while (!candidates_.empty() && mesh_.face_count() > options_.target_faces) {
                step();
                pack();
            }
            if (mesh_.face_count() <= options_.target_faces) break;
            if (count(Verdict::kAccepted) == before || !options_.refresh) {
                result_.stopped = std::isfinite(options_.max_error) ? StopReason::kMaxError : StopReason::kTopology;
                break;
            }
            ++result_.refreshes;
        }
        return result_;
    }

private:
    /// Removes what costs next to nothing, as long as a whole sweep stays above the target.
    void thin() {
        const double scale2 = options_.scale * options_.scale;
        Thinning thinning(mesh_, tree_, quadrics_, options_, bounds_,
                          std::min(options_.max_cost, kThinCost * scale2 * scale2));
        for (int sweep = 0; sweep < kMostSweeps && mesh_.face_count() * kLeastLeft > options_.target_faces; ++sweep) {
            const std::uint32_t before = mesh_.face_count();
            if (2 * thinning.sweep(result_.verdicts) < kLeastGain * before) break;
            pack();
        }
    }

    /// When many faces are gone, the others are brought together, and their tree is built anew.
    void pack() {
        if (mesh_.face_count() >= mesh_.face_end() * kCompactBelow) return;
        mesh_.compact_faces();
        tree_.build(mesh_);
    }

    /// Fixes the vertices of faces that reach beyond the limits, so that all faces that change lie within, before and
    /// after: the limits are convex. Returns those that were not fixed before.
    static std::vector<VertexId> fix_beyond(Mesh& mesh, const Box& limits) {
        std::vector<VertexId> beyond;
        const auto is_within = [&](VertexId v) {
            const Vec3 p = mesh.position(v);
            return max(p, limits.low) == p && min(p, limits.high) == p;
        };
        for (std::uint32_t f = 0; f < mesh.face_end(); ++f) {
            if (!mesh.is_alive(FaceId{f})) continue;
            const auto& corners = mesh[FaceId{f}].vertices;
            if (std::all_of(corners.begin(), corners.end(), is_within)) continue;
            for (VertexId v : corners) {
                if (mesh[v].is_fixed) continue;
                mesh[v].is_fixed = true;
                beyond.push_back(v);
            }
        }
        return beyond;
    }

    std::uint64_t count(Verdict verdict) const { return result_.verdicts[static_cast<int>(verdict)]; }

    /// Examines the cheapest candidate: collapses it, or puts it aside.
    void step() {
        const VertexId goes = candidates_.goes(), stays = candidates_.stays();
        gather(mesh_, goes, stays, star_);
        Vec3 position;
        const Verdict verdict = examine(position);
        ++result_.verdicts[static_cast<int>(verdict)];
        if (verdict == Verdict::kAccepted)
            collapse(position);
        else
            candidates_.refuse();
        if (options_.on_progress && (++steps_ & 0x3FFF) == 0) options_.on_progress();
    }

    Verdict examine(Vec3& position) {
        const Verdict topology = topology_verdict(mesh_, star_);
        if (topology != Verdict::kAccepted) return topology;
        const EdgeEnds edge = quadrics_.ends(mesh_, star_.goes, star_.stays);
        const Placement cheapest = place(edge);
        position = cheapest.position;
        keep_level(position);
        ShapeResult shape = shape_verdict(star_, position, bounds_);
        if (is_flat(edge, cheapest.cost)) prefer_average(edge, position, shape);
        if (shape.verdict != Verdict::kAccepted) return shape.verdict;
        if (!is_within_limits(position)) return Verdict::kIntersect;
        if (options_.intersect_check) return obstruction_.verdict(mesh_, tree_, star_, position, bounds_);
        return pinches_around(mesh_, star_, position, bounds_) ? Verdict::kPinch : Verdict::kAccepted;
    }

    /// Where the whole star lies in a plane square to an axis, the merged vertex does, to the last bit.
    void keep_level(Vec3& position) const {
        for (int axis = 0; axis < 3; ++axis)
            if (star_.is_level(axis)) position[axis] = star_.at_goes[axis];
    }

    bool is_flat(const EdgeEnds& edge, double cost) const {
        const double weight = edge.goes_quadric.unpack().weight() + edge.stays_quadric.unpack().weight();
        return cost <= kFlat * weight * length2(edge.goes - edge.stays);
    }

    /// On a flat star every place in the plane costs nothing: the average of the link is taken where it gives the
    /// better worst quality (P quality test 2).
    void prefer_average(const EdgeEnds& edge, Vec3& position, ShapeResult& shape) {
        Vec3 average = average_of_link(edge);
        keep_level(average);
        if (!is_flat(edge, cost_at(edge, average))) return;
        const ShapeResult other = shape_verdict(star_, average, bounds_);
        if (other.verdict == Verdict::kAccepted &&
            (shape.verdict != Verdict::kAccepted || other.worst_quality3 > shape.worst_quality3)) {
            position = average;
            shape = other;
        } else {
            set_normals(star_, position);
        }
    }

    /// Coordinates on the box stay.
    Vec3 average_of_link(const EdgeEnds& edge) const {
        Vec3 sum;
        for (VertexId v : star_.link) sum += mesh_.position(v) - edge.stays;
        Vec3 average = edge.stays + sum / static_cast<double>(star_.link.size());
        for (int axis = 0; axis < 3; ++axis)
            if (edge.stays_sides >> (2 * axis) & 3) average[axis] = edge.stays[axis];
        return average;
    }

    bool is_within_limits(Vec3 p) const {
        for (int axis = 0; axis < 3; ++axis) {
            if (mesh_[star_.stays].sides >> (2 * axis) & 3) continue;
            if (!(options_.limits.low[axis] < p[axis] && p[axis] < options_.limits.high[axis])) return false;
        }
        return true;
    }

    void collapse(Vec3 position) {
        quadrics_.merge(mesh_, star_.goes, star_.stays, position);
        collapse_edge(mesh_, tree_, star_, position);
        candidates_.update(star_.goes, star_.stays);
    }

    Mesh& mesh_;
    const DecimateOptions& options_;
    ShapeBounds bounds_;
    FaceTree tree_;
    std::vector<VertexId> beyond_;
    VertexQuadrics quadrics_;
    Candidates candidates_;
    Obstruction obstruction_;
    EdgeStar star_;
    DecimateResult result_;
    std::uint64_t steps_ = 0;
};

}  // namespace

DecimateResult decimate(Mesh& mesh, const DecimateOptions& options) {
    if (mesh.face_count() <= options.target_faces) return {};
    return Decimation(mesh, options).run();
}

}  // namespace regionmesh
