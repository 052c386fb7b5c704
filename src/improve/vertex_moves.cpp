#include "improve/vertex_moves.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "improve/on_star.h"
#include "judge/verdict/verdicts.h"
#include "mesh/strata.h"

namespace regionmesh {
namespace {

/// Of the places found, the best ones are tested.
constexpr std::size_t kAttempts = 3, kFreeAttempts = 30;

/// Shares of the way to a target, and along a line toward the next vertex.
constexpr std::array kSteps{1.0, 0.5, 0.25, 0.1};
constexpr std::array kLineSteps{0.05, 0.15, 0.3, 0.5};

/// Lengths of moves in any direction, in units of the scale.
constexpr std::array kFreeSteps{0.01, 0.02, 0.04, 0.08, 0.16, 0.3};

/// Height of an equilateral triangle of side 1.
constexpr double kIdealHeight = 0.8660254037844386;

/// The axes, the diagonals between two and between three of them, both ways, as unit vectors; those that leave no side.
std::vector<Vec3> directions_along(SideSet sides) {
    std::vector<Vec3> directions;
    for (int n = 0; n < 27; ++n) {
        const Vec3 way(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1);
        bool leaves = length2(way) == 0;
        for (int axis = 0; axis < 3; ++axis) leaves |= way[axis] != 0 && (sides >> (2 * axis) & 3) != 0;
        if (!leaves) directions.push_back(way / length(way));
    }
    return directions;
}

double distance_to_segment(Vec3 p, Vec3 a, Vec3 b) {
    const Vec3 along = b - a;
    const double share = std::clamp(dot(p - a, along) / length2(along), 0.0, 1.0);
    return length(p - (a + share * along));
}

}  // namespace

VertexMoves::VertexMoves(Judge& judge, SurfaceDrift& drift, double poor)
    : judge_(judge), mesh_(judge.mesh()), drift_(drift), poor3_(poor * poor * poor) {}

bool VertexMoves::try_move(VertexId v) {
    if (mesh_[v].label_count > 3 || !gather(v)) return false;
    if (mesh_[v].label_count == 3)
        gather_line();
    else if (change_.star.is_interface)
        gather_interface();
    return take_best(v, kAttempts);
}

bool VertexMoves::try_any_direction(VertexId v) {
    if (!gather(v)) return false;
    const EdgeStar& star = change_.star;
    const Vec3 at = star.at_goes;
    for (const Vec3 direction : directions_along(mesh_[v].sides))
        for (const double share : kFreeSteps) {
            const Vec3 p = at + share * judge_.promises().scale * direction;
            add_candidate(p, step_to(star, p));
        }
    return take_best(v, kFreeAttempts);
}

/// Gathers the star of a vertex that may move, without candidates.
bool VertexMoves::gather(VertexId v) {
    const Vertex& vertex = mesh_[v];
    if (!vertex.is_alive || vertex.is_fixed || vertex.star == kNoCorner) return false;
    gather_move(mesh_, v, change_.star);
    now_ = shape_at(change_.star.at_goes);
    drift_now_ = drift_.of(v);
    for (VertexId w : change_.star.link) drift_now_ = std::max(drift_now_, drift_.of(w));
    candidates_.clear();
    return true;
}

bool VertexMoves::take_best(VertexId v, std::size_t attempts) {
    std::sort(candidates_.begin(), candidates_.end(),
              [](const Candidate& a, const Candidate& b) { return a.energy < b.energy; });
    for (std::size_t n = 0; n < std::min(candidates_.size(), attempts); ++n) {
        const Candidate& best = candidates_[n];
        if (verdict_at(judge_, change_, {best.at}) != Verdict::kAccepted) continue;
        judge_.apply(change_);
        drift_.set(v, drift_now_, best.step);
        return true;
    }
    return false;
}

FanShape VertexMoves::shape_at(Vec3 p) const {
    FanShape shape;
    for (int n = 0; n < change_.star.face_count(); ++n) shape.add(p, change_.star.at_a(n), change_.star.at_b(n));
    return shape;
}

void VertexMoves::add_candidate(Vec3 p, double step) {
    if (!drift_.may_move(drift_now_, step, now_.worst3 < poor3_)) return;
    const FanShape shape = shape_at(p);
    if (shape.is_better_than(now_)) candidates_.push_back({p, shape.energy, step});
}

/// Along the two edges of the line that passes through the vertex.
void VertexMoves::gather_line() {
    gather_line_ends(mesh_, change_.star, line_ends_);
    if (line_ends_.size() != 2) return;
    const std::array<Vec3, 2> ends{mesh_.position(line_ends_[0]), mesh_.position(line_ends_[1])};
    const Vec3 at = change_.star.at_goes;
    for (int n = 0; n < 2; ++n)
        for (double share : kLineSteps) {
            const Vec3 p = at + share * (ends[n] - at);
            add_candidate(p, distance_to_segment(at, p, ends[1 - n]));
        }
}

/// Toward the middle of the link, toward the places where faces would be equilateral, and toward that of the worst.
void VertexMoves::gather_interface() {
    const EdgeStar& star = change_.star;
    const Vec3 at = star.at_goes;
    Vec3 up, middle, ideal, worst_ideal;
    double lengths = 0, weights = 0, worst3 = 2;
    for (int n = 0; n < star.face_count(); ++n) {
        const Vec3 a = star.at_a(n), b = star.at_b(n), normal = area_vector(at, a, b);
        up += normal;
        const double side = length(b - a), size = length(normal);
        lengths += side;
        middle += (0.5 * side) * (a + b);
        const Vec3 own = 0.5 * (a + b) + (size > 0 ? kIdealHeight / size * cross(normal, b - a) : Vec3{});
        const double own3 = quality_terms(at, a, b).cube(), weight = 1 / std::max(own3, 1e-12);
        ideal += weight * own;
        weights += weight;
        if (own3 < worst3) worst_ideal = own;
        worst3 = std::min(worst3, own3);
    }
    if (length2(up) == 0) return;
    for (Vec3 target : {middle / lengths, ideal / weights, worst_ideal}) add_steps_to(target, up);
}

void VertexMoves::add_steps_to(Vec3 target, Vec3 up) {
    const EdgeStar& star = change_.star;
    const Vec3 at = star.at_goes;
    const double up_size = length(up);
    for (double share : kSteps) {
        const auto p = point_on_star(star, at, at + share * (target - at), up);
        if (!p) continue;
        const auto old = point_on_star(star, *p, at, up);
        if (old) add_candidate(*p, std::abs(dot(up, *old - at)) / up_size);
    }
}

}  // namespace regionmesh
