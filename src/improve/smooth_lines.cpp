#include "regionmesh/smooth_lines.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/option_range.h"
#include "judge/error_bound.h"
#include "judge/try_together.h"
#include "judge/verdict/verdicts.h"
#include "mesh/strata.h"
#include "regionmesh/box_axes.h"

namespace regionmesh {
namespace {

/// Weight of the squared distance from where a vertex was (docs/explanation/smoothing.md): waves shorter than 2 pi
/// over its fourth root, eleven times the scale, go. Foams hardly change from 0.01 to 0.2.
constexpr double kKeep = 0.1;

/// Of the scale. Shorter steps are not made, nor is a goal that was refused tried again before it has moved by this.
constexpr double kLeastStep = 0.02;

/// Of the scale: how far from where it was a vertex may get.
constexpr double kMostMove = 1;

/// Shares of the way to the goal that are tried.
constexpr std::array kShares{1.0, 0.5, 0.25};

/// Lines that end in a vertex: two where a line passes, four at a quadruple point.
constexpr std::size_t kMostEnds = 4;

constexpr std::uint32_t kNoNumber = ~0u;

/// Do the faces of the star together get larger? They do where a vertex leaves the surfaces round it and makes folds.
bool area_grows(const EdgeStar& star) {
    double before = 0, after = 0;
    for (int n = 0; n < star.face_count(); ++n) {
        before += std::sqrt(star.pairs[n / 2].old_length2[n % 2]);
        after += std::sqrt(star.new_length2(n));
    }
    return after > before;
}

/// The sum of terms w |a x + b|^2 as a function of the point x.
struct PointEnergy {
    double weight = 0;
    Vec3 sum;

    void add(double w, double a, Vec3 b) {
        weight += w * a * a;
        sum += (-w * a) * b;
    }
    Vec3 least() const { return sum / weight; }
};

class LineSmoother {
public:
    LineSmoother(Mesh& mesh, const SmoothLinesOptions& options)
        : mesh_(mesh),
          options_(options),
          kept_(kept_of(mesh, options)),
          judge_(mesh, kept_, {.threads = options.threads}),
          number_(mesh.vertex_end(), kNoNumber) {
        for (std::uint32_t v = 0; v < mesh.vertex_end(); ++v) {
            report_progress(v);
            find_ends(VertexId{v});
        }
    }

    void run(SmoothLinesResult& result) {
        result.vertices = vertices_.size();
        result.turn_before = mean_turn();
        while (result.sweeps < options_.sweeps) {
            const std::uint64_t moves = sweep();
            ++result.sweeps;
            result.moves += moves;
            if (moves == 0) break;
        }
        result.turn_after = mean_turn();
        for (const LineVertex& vertex : vertices_)
            result.largest_displacement =
                std::max(result.largest_displacement, length(mesh_.position(vertex.v) - vertex.origin));
    }

private:
    /// The promises; no faces may cross, whatever the options say. The error rises by no more than the moves.
    static Promises kept_of(const Mesh& mesh, const SmoothLinesOptions& options) {
        Promises kept = options.promises;
        kept.intersect_check = true;
        kept.max_error = std::min(kept.max_error, largest_error_bound(mesh) + kMostMove * kept.scale);
        return kept;
    }

    struct LineVertex {
        VertexId v;
        std::uint32_t count = 0;
        std::array<VertexId, kMostEnds> ends{};  // the next vertices along its lines
        Vec3 origin;
        Vec3 refused{HUGE_VAL, 0, 0};  // goal that could not be approached
        bool is_due = true;            // something that its goal depends on has moved
    };

    /// A step of one of them.
    struct Trial {
        Change change = {};
        Box box = {};  // see try_together
        Vec3 goal = {};
        enum class Outcome : std::uint8_t { kNone, kAccepted, kRefused } outcome = Outcome::kNone;
    };

    void report_progress(std::uint32_t n) {
        if (options_.on_progress && (n & 0xFFF) == 0) options_.on_progress();
    }

    /// Vertices on edges of the box stay: they have three labels, too, those of a region and of two sides.
    void find_ends(VertexId v) {
        const Vertex& vertex = mesh_[v];
        if (!vertex.is_alive || vertex.is_fixed || vertex.star == kNoCorner) return;
        if ((vertex.sides & kOnHull) != 0 || std::popcount(static_cast<unsigned>(vertex.sides & kBoxSides)) > 1) return;
        if (vertex.label_count < 3 || vertex.label_count > 4) return;
        gather_move(mesh_, v, trial_.change.star);
        gather_line_ends(mesh_, trial_.change.star, ends_);
        if (ends_.size() != (vertex.label_count == 3 ? 2 : 4)) return;
        LineVertex own{.v = v, .count = static_cast<std::uint32_t>(ends_.size()), .origin = vertex.position};
        std::copy(ends_.begin(), ends_.end(), own.ends.begin());
        number_[index(v)] = static_cast<std::uint32_t>(vertices_.size());
        vertices_.push_back(own);
    }

    std::uint64_t sweep() {
        std::vector<std::uint32_t> due;
        for (std::uint32_t n = 0; n < vertices_.size(); ++n)
            if (vertices_[n].is_due) due.push_back(n);
        std::uint64_t moves = 0;
        try_in_stripes(
            static_cast<std::uint32_t>(due.size()), options_.threads, trial_,
            [&](std::uint32_t n, Trial& trial) { test(vertices_[due[n]], trial); },
            [&](std::uint32_t n, Trial& trial) {
                report_progress(n);
                LineVertex& own = vertices_[due[n]];
                if (trial.outcome == Trial::Outcome::kRefused) own.refused = trial.goal;
                if (trial.outcome != Trial::Outcome::kAccepted) return false;
                judge_.apply(trial.change);
                note_moved(own);
                ++moves;
                return true;
            });
        return moves;
    }

    /// The goals of the vertex and of the next two along its lines change.
    void note_moved(LineVertex& own) {
        own.is_due = true;
        for (std::uint32_t n = 0; n < own.count; ++n)
            for (const VertexId v : {own.ends[n], beyond(own.ends[n], own.v)})
                if (v != kNoVertex && number_[index(v)] != kNoNumber) vertices_[number_[index(v)]].is_due = true;
    }

    /// The vertex after `from` and `at` on their line, if the line goes on.
    VertexId beyond(VertexId at, VertexId from) const {
        const std::uint32_t number = number_[index(at)];
        if (number == kNoNumber || vertices_[number].count != 2) return kNoVertex;
        const auto& ends = vertices_[number].ends;
        return ends[0] == from ? ends[1] : ends[0];
    }

    /// Where the lines through the vertex turn least. The energy of a vertex of a line with edges of lengths g and h is
    /// that of the second divided difference: |turn|^2 over their mean, where the turn is the difference of their
    /// directions as long as lengths stay.
    Vec3 goal_of(const LineVertex& own) const {
        const Vec3 at = mesh_.position(own.v);
        PointEnergy energy;
        double reach = 0;  // half the length of its edges
        std::array<Vec3, kMostEnds> p;
        std::array<double, kMostEnds> h;
        for (std::uint32_t n = 0; n < own.count; ++n) {
            p[n] = mesh_.position(own.ends[n]);
            h[n] = length(p[n] - at);
            if (h[n] == 0) return at;
            reach += h[n] / 2;
            const VertexId far = beyond(own.ends[n], own.v);
            if (far == kNoVertex) continue;
            const Vec3 onward = mesh_.position(far) - p[n];
            const double g = length(onward);
            if (g > 0) energy.add(2 / (g + h[n]), 1 / h[n], onward / g - p[n] / h[n]);
        }
        if (own.count == 2) energy.add(1 / reach, -(1 / h[0] + 1 / h[1]), p[0] / h[0] + p[1] / h[1]);
        const double scale2 = kept_.scale * kept_.scale;
        energy.add(kKeep * reach / (scale2 * scale2), 1, -own.origin);

        Vec3 step = energy.least() - at;
        if (own.count == 2) {  // not along the line
            const Vec3 along = p[1] - p[0];
            if (length2(along) > 0) step = step - (dot(step, along) / length2(along)) * along;
        }
        Vec3 moved = at + step - own.origin;
        const double most = kMostMove * kept_.scale, size = length(moved);
        if (size > most) moved = (most / size) * moved;
        Vec3 goal = own.origin + moved;
        for (int axis = 0; axis < 3; ++axis)
            if ((mesh_[own.v].sides >> (2 * axis) & 3) != 0) goal[axis] = at[axis];
        return goal;
    }

    /// If the vertex after the next one along a line moves at the same time, the goal is that of before: then the
    /// vertex is due again.
    void test(LineVertex& own, Trial& trial) const {
        const double least = kLeastStep * kept_.scale;
        const Vec3 at = mesh_.position(own.v), goal = goal_of(own);
        own.is_due = false;
        trial.outcome = Trial::Outcome::kNone;
        trial.box = {at, at};
        if (length(goal - at) < least || length(goal - own.refused) < least) return;
        EdgeStar& star = trial.change.star;
        gather_move(mesh_, own.v, star);
        trial.box.add(star.link_box.low);
        trial.box.add(star.link_box.high);
        trial.box.add(goal);
        trial.goal = goal;
        trial.outcome = Trial::Outcome::kAccepted;
        for (const double share : kShares) {
            const Vec3 to = star.kept_level(share == 1 ? goal : at + share * (goal - at));
            set_normals(star, to);
            if (!area_grows(star) && verdict_at(judge_, trial.change, {to}) == Verdict::kAccepted) return;
        }
        trial.outcome = Trial::Outcome::kRefused;
    }

    double mean_turn() const {
        double sum = 0;
        std::uint64_t count = 0;
        const auto place = [&](VertexId v) {
            Vec3 p = mesh_.position(v);
            p.z /= kept_.scale_z;
            return p;
        };
        for (const LineVertex& vertex : vertices_) {
            if (vertex.count != 2) continue;
            const Vec3 at = place(vertex.v), a = at - place(vertex.ends[0]), b = place(vertex.ends[1]) - at;
            sum += std::atan2(length(cross(a, b)), dot(a, b));
            ++count;
        }
        return count > 0 ? sum / static_cast<double>(count) * 180 / std::numbers::pi : 0;
    }

    const Mesh& mesh_;
    const SmoothLinesOptions& options_;
    Promises kept_;
    Judge judge_;
    std::vector<std::uint32_t> number_;  // by vertex: place in vertices_
    std::vector<LineVertex> vertices_;
    Trial trial_;
    std::vector<VertexId> ends_;
};

}  // namespace

SmoothLinesResult smooth_lines(Mesh& mesh, const SmoothLinesOptions& options) {
    require_in_range(options.promises);
    require_along_axes(mesh);
    SmoothLinesResult result;
    count_labels(mesh, options.threads);
    LineSmoother(mesh, options).run(result);
    result.error_bound = largest_error_bound(mesh);
    return result;
}

}  // namespace regionmesh
