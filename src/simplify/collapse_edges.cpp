#include "simplify/collapse_edges.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/box.h"
#include "judge/try_together.h"
#include "judge/verdict/quality.h"
#include "judge/verdict/verdicts.h"
#include "mesh/strata.h"
#include "simplify/rank/candidates.h"
#include "simplify/sweep/flat_vertices.h"
#include "simplify/sweep/half_candidates.h"
#include "simplify/sweep/prepass.h"
#include "simplify/sweep/sweep_marks.h"
#include "simplify/tuning.h"

namespace regionmesh {
namespace {

/// Fixes the vertices of faces that reach out of a box while it lives, so that all faces that change lie inside, before
/// and after: the box is convex.
class FixedOutside {
public:
    FixedOutside(Mesh& mesh, const Box& box) : mesh_(mesh) {
        for (std::uint32_t v = 0; v < mesh.vertex_end(); ++v) {
            if (!mesh.is_alive(VertexId{v}) || is_within(mesh.position(VertexId{v}), box)) continue;
            mesh.for_star(VertexId{v}, [&](FaceId f, int) {
                for (VertexId corner : mesh[f].vertices) {
                    if (mesh[corner].is_fixed) continue;
                    mesh[corner].is_fixed = true;
                    fixed_.push_back(corner);
                }
            });
        }
    }
    ~FixedOutside() {
        for (VertexId v : fixed_) mesh_[v].is_fixed = false;
    }
    FixedOutside(const FixedOutside&) = delete;
    FixedOutside& operator=(const FixedOutside&) = delete;

private:
    Mesh& mesh_;
    std::vector<VertexId> fixed_;  // that were not before
};

class CollapseLoop {
public:
    CollapseLoop(Mesh& mesh, const SimplifyOptions& options, const CollapseBounds& bounds)
        : mesh_(mesh),
          options_(options),
          is_refreshing_(bounds.refresh),
          is_large_(bounds.is_large),
          threads_(bounds.threads),
          histogram_(bounds.histogram),
          outside_(mesh, bounds.limits),
          flat_(remove_flat(mesh, options, bounds)),
          judge_(mesh, options.promises, judge_options(options, bounds)),
          placement_(make_placement(mesh, options, bounds.threads)),
          candidates_(mesh, *placement_, options, bounds.is_large ? EdgeOrder::kInSweeps : EdgeOrder::kByCost),
          halves_(mesh.vertex_count() / 2),
          trials_(1) {}

    CollapseResult run() {
        const std::uint32_t faces = mesh_.face_count() + 2 * flat_, vertices = mesh_.vertex_count() + flat_;
        result_.verdicts[static_cast<int>(Verdict::kAccepted)] += flat_;
        sweep();
        if (histogram_) {
            histogram_->removed.assign(histogram_->costs.size() + 1, {});
            histogram_->removed.front() = {faces - mesh_.face_count(), vertices - mesh_.vertex_count()};
        }
        for (;;) {
            if (is_at_target()) break;
            result_.verdicts[static_cast<int>(Verdict::kStrata)] += candidates_.refresh(threads_);
            halves_.clear();
            const std::uint64_t before = accepted(), over_error = count_of(StopReason::kMaxError, result_.verdicts);
            while (!(candidates_.empty() && halves_.empty()) && !is_at_target()) {
                step();
                pack();
            }
            result_.bytes =
                std::max(result_.bytes, judge_.bytes() + candidates_.bytes() + placement_->bytes() + halves_.bytes());
            if (is_at_target()) break;
            if (accepted() == before || !is_refreshing_) {
                const bool is_error = candidates_.has_edges_over_error() ||
                                      count_of(StopReason::kMaxError, result_.verdicts) > over_error;
                result_.stopped = is_error ? StopReason::kMaxError : StopReason::kTopology;
                break;
            }
            ++result_.refreshes;
        }
        return result_;
    }

private:
    /// Returns the number of vertices that went.
    static std::uint32_t remove_flat(Mesh& mesh, const SimplifyOptions& options, const CollapseBounds& bounds) {
        count_labels(mesh, bounds.threads);
        Judge judge(mesh, options.promises, {.sees_others = false, .log = bounds.log});
        const std::uint32_t removed = remove_flat_vertices(judge, options.target_faces);
        if (removed > 0) judge.pack(bounds.threads);
        return removed;
    }

    static JudgeOptions judge_options(const SimplifyOptions& options, const CollapseBounds& bounds) {
        return {.limits = bounds.limits,
                .bounds_regions = options.bounds_regions,
                .faces = bounds.is_large ? FaceTree::Faces::kInPairs : FaceTree::Faces::kOneByOne,
                .log = bounds.log,
                .threads = bounds.threads};
    }

    bool is_at_target() const { return mesh_.face_count() <= options_.target_faces; }
    std::uint64_t count(Verdict verdict) const { return result_.verdicts[static_cast<int>(verdict)]; }
    std::uint64_t accepted() const { return count(Verdict::kAccepted); }

    /// The prepass, as long as a whole sweep stays above the target.
    void sweep() {
        const double scale2 = options_.promises.scale * options_.promises.scale;
        double most = std::min(options_.max_cost, placement_->prepass_cost() * scale2 * scale2);
        if (histogram_) most = std::min(most, histogram_->costs.front());
        Prepass prepass(judge_, *placement_, options_, most);
        sweep_above(options_.target_faces, mesh_, [&] {
            pack();
            return prepass.sweep(result_.verdicts);
        });
        for (const Prepass::Fault fault : {Prepass::Fault::kSliver, Prepass::Fault::kFold}) {
            if (fault == Prepass::Fault::kFold && !options_.removes_folds) continue;
            prepass.find(fault, threads_);
            for (int n = 0; n < kMostFaultSweeps; ++n)
                if (prepass.remove(fault, result_.verdicts, is_large_, threads_) == 0) break;
        }
        pack();
    }

    /// When many faces are gone, the others are brought together, and their tree is built anew.
    void pack() {
        if (mesh_.face_count() >= mesh_.face_end() * kCompactBelow) return;
        judge_.pack(threads_);
    }

    void step() {
        // A collapse takes two faces and seldom more.
        if (!candidates_.empty()) candidates_.find_next((mesh_.face_count() - options_.target_faces + 1) / 2);
        if (halves_.empty() || (!candidates_.empty() && candidates_.rank() <= halves_.least_rank())) {
            note_level(candidates_.rank());
            try_next();
        } else {
            note_level(halves_.least_rank());
            try_half(halves_.take());
        }
        if (options_.on_progress && (++steps_ & 0x3FFF) == 0) options_.on_progress(mesh_.face_count());
    }

    void note_level(double rank) {
        if (CollapseLog* log = judge_.log()) log->level = std::max(log->level, rank);
    }

    /// Tests the next candidates where they cost least, at the same time, and in their order collapses them or puts
    /// them aside. One that lies near an earlier one which was collapsed comes once more: its test may no longer hold.
    void try_next() {
        const std::span<const VertexId> next = candidates_.next();
        if (trials_.size() < next.size()) trials_.resize(next.size());
        const std::uint32_t threads = placement_->ranks_in_parallel() ? threads_ : 1;
        made_.clear();
        try_together(
            std::span(trials_).first(next.size()), threads, [&](std::uint32_t n) { test(trials_[n], next[n]); },
            [&](std::uint32_t n) { return !is_at_target() && settle(trials_[n]); });
        parallel_for(static_cast<std::uint32_t>(made_.size()), threads, [&](std::uint32_t n) {
            Trial& made = *made_[n];
            candidates_.rank_around(made.change.star.goes, made.change.star.stays, made.scratch, made.ranked);
        });
        for (const Trial* made : made_)
            candidates_.update(made->change.star.goes, made->change.star.stays, made->ranked);
    }

    /// What is found out about a candidate while others are tested, too.
    struct Trial {
        Change change;
        Verdict verdict = Verdict::kAccepted;
        Box box = {};                     // see try_together
        Candidates::Best after = {};      // the next edge of the end that goes, where this one is refused
        std::optional<double> half = {};  // rank of the half collapse, where this is a second choice
        std::vector<Candidates::Ranked> ranked = {};
        Candidates::Scratch scratch = {};
        std::vector<HalfCost> half_costs = {};
    };

    void test(Trial& trial, VertexId goes) {
        Change& change = trial.change;
        const EdgeStar& star = change.star;
        gather(mesh_, goes, candidates_.stays(goes), change.star);
        change.position = star.at_stays;
        trial.verdict = examine(judge_, change, [&] { return placement_->place(mesh_, star); });
        trial.box = star.link_box;
        for (Vec3 p : {star.at_goes, star.at_stays, change.position}) trial.box.add(p);
        for (VertexId apex : star.apexes) trial.box.add(mesh_.position(apex));
        if (trial.verdict == Verdict::kAccepted) return;
        trial.half = is_cured_elsewhere(trial.verdict) ? rank_of_second_choice(trial) : std::nullopt;
        trial.after = candidates_.after_refusal(goes, trial.scratch);
    }

    /// Returns whether it is collapsed.
    bool settle(Trial& trial) {
        const EdgeStar& star = trial.change.star;
        ++result_.verdicts[static_cast<int>(trial.verdict)];
        if (trial.verdict == Verdict::kAccepted) {
            made_.push_back(&trial);
            apply(trial.change, histogram_ ? cost_of(star) : 0);
        } else {
            if (trial.half) halves_.add({*trial.half, star.goes, star.stays});
            candidates_.refuse(star.goes, trial.after);
        }
        candidates_.note(trial.scratch.notes);
        return trial.verdict == Verdict::kAccepted;
    }

    /// The half collapse is a second choice, unless `fold` or `quality` would refuse it on the mesh as it is now:
    /// nearly all such edges are refused when their turn comes, too.
    std::optional<double> rank_of_second_choice(Trial& trial) const {
        const EdgeStar& star = trial.change.star;
        if (fan_quality3(mesh_, star, star.stays, star.at_stays, judge_.bounds()) == 0) return {};
        return rank_of_half(star.goes, star.stays, trial.half_costs);
    }

    /// None above the largest cost or error.
    std::optional<double> rank_of_half(VertexId goes, VertexId stays, std::vector<HalfCost>& costs) const {
        placement_->rank_halves(mesh_, goes, {&stays, 1}, costs);
        const HalfCost& half = costs.front();
        if (!half.is_within(options_.max_cost, options_.promises.max_error)) return {};
        // Rounding may leave less than 0.
        return std::max(half.cost, 0.0) +
               kLengthShare * half.weight * length2(mesh_.position(stays) - mesh_.position(goes));
    }

    /// Tests it as the mesh is now. Where the edge has become dearer it waits once more.
    void try_half(HalfCandidates::Edge edge) {
        const auto [rank, goes, stays] = edge;
        if (!mesh_.is_alive(goes) || !mesh_.is_alive(stays) || !candidates_.may_go(goes, stays)) return;
        Trial& trial = trials_.front();
        const auto now = rank_of_half(goes, stays, trial.half_costs);
        if (!now) return;
        if (*now > rank * kSameRank) return halves_.add({*now, goes, stays});
        EdgeStar& star = trial.change.star;
        gather_half(mesh_, goes, stays, star);
        const Verdict verdict = examine(judge_, trial.change, [&] { return Places{star.at_stays}; });
        ++result_.verdicts[static_cast<int>(verdict)];
        if (verdict != Verdict::kAccepted) return;
        apply(trial.change, trial.half_costs.front().cost);
        candidates_.rank_around(goes, stays, trial.scratch, trial.ranked);
        candidates_.note(trial.scratch.notes);
        candidates_.update(goes, stays, trial.ranked);
    }

    /// Without the share of the length, which its rank has.
    double cost_of(const EdgeStar& star) {
        placement_->rank(mesh_, star.goes, {&star.stays, 1}, edge_costs_);
        return edge_costs_.front().cost;
    }

    void apply(Change& change, double cost) {
        const std::uint32_t before = mesh_.face_count();
        placement_->collapse(mesh_, change.star, change.position);
        judge_.apply(change);
        if (histogram_) histogram_->add(cost, before - mesh_.face_count());
    }

    Mesh& mesh_;
    const SimplifyOptions& options_;
    bool is_refreshing_, is_large_;
    std::uint32_t threads_;
    CostHistogram* histogram_;
    FixedOutside outside_;
    std::uint32_t flat_;  // vertices that went before all else
    Judge judge_;
    std::unique_ptr<Placement> placement_;
    Candidates candidates_;
    HalfCandidates halves_;
    std::vector<Trial> trials_;         // one, or one for each stripe of a sweep
    std::vector<Trial*> made_;          // of these, those that were collapsed
    std::vector<EdgeCost> edge_costs_;  // of one edge
    CollapseResult result_;
    std::uint64_t steps_ = 0;
};

}  // namespace

CollapseResult collapse_edges(Mesh& mesh, const SimplifyOptions& options, const CollapseBounds& bounds) {
    if (mesh.face_count() <= options.target_faces) return {};
    return CollapseLoop(mesh, options, bounds).run();
}

}  // namespace regionmesh
