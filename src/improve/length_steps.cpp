#include "improve/length_steps.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/triangle.h"
#include "improve/edge_flips.h"
#include "improve/fan_shape.h"
#include "improve/on_star.h"
#include "improve/surface_drift.h"
#include "judge/verdict/verdicts.h"
#include "mesh/strata.h"
#include "regionmesh/remesh.h"

namespace regionmesh {
namespace {

/// Most height of a step over the old faces, as a share of the wanted length. Larger ones round off the edges of
/// solids.
constexpr double kMostHeight = 0.05;

/// A step that makes faces worse leaves at least this quality. Equilateral is 0.26.
constexpr double kFairQuality = 0.15;

/// A split leaves this quality: of a needle it makes a flat face that a flip joins to its neighbours, but none whose
/// corners coincide.
constexpr double kLeastQuality = 0.03;

/// Energy of spokes that is worth a move: share of it that goes, and least amount.
constexpr double kWorthMove = 0.98, kLeastGain = 1e-3;

/// Shares of the way to a target, and along a line toward the next vertex.
constexpr std::array kSteps{1.0, 0.5, 0.2};
constexpr std::array kLineSteps{0.04, 0.1, 0.2, 0.35, 0.5};

/// Of the places found, the best ones are tested.
constexpr std::size_t kAttempts = 3;

/// Most of wanted lengths of an edge that a collapse may make of one shorter than any wanted.
constexpr double kLongest = 1.7;

double cube(double x) { return x * x * x; }

/// May faces become as these are? None is below a fair quality that none was below before.
bool is_fair(const FanShape& before, const FanShape& after) {
    return after.worst3 > 0 && after.worst3 >= std::min(before.worst3, cube(kFairQuality));
}

/// Of an edge of x wanted lengths: 0 where it has that one, and without bound toward 0.
double length_energy(double x) {
    const double off = x < 1 ? 1 / std::max(x, 1e-6) - 1 : x - 1;
    return off * off;
}

double angle_at(Vec3 at, Vec3 a, Vec3 b) { return std::atan2(length(cross(a - at, b - at)), dot(a - at, b - at)); }

}  // namespace

LengthSteps::LengthSteps(Judge& judge, double wanted)
    : judge_(judge),
      mesh_(judge.mesh()),
      wanted_(wanted),
      inverse_(1 / wanted),
      inverse_z_(1 / judge.promises().scale_z),
      height_(kMostHeight * wanted) {}

/// Of the edges that begin at each corner.
std::array<double, 3> LengthSteps::lengths_of(FaceId f) const {
    const auto p = mesh_.corners(f);
    return {length_of(p[0], p[1]), length_of(p[1], p[2]), length_of(p[2], p[0])};
}

bool LengthSteps::try_split(FaceId f) {
    const auto lengths = lengths_of(f);
    const auto n = static_cast<int>(std::max_element(lengths.begin(), lengths.end()) - lengths.begin());
    if (lengths[n] <= kLong) return false;
    const auto corners = mesh_[f].vertices;
    const VertexId u = corners[n], v = corners[(n + 1) % 3];
    if (mesh_[u].is_fixed || mesh_[v].is_fixed) return false;
    judge_.propose_split(u, v, change_);
    const EdgeStar& star = change_.star;
    FanShape before, after;
    for (const FaceId old : change_.gone) {
        const auto p = mesh_.corners(old);
        before.add(p[0], p[1], p[2]);
    }
    for (int face = 0; face < star.face_count(); ++face) after.add(star.at_goes, star.at_a(face), star.at_b(face));
    const bool is_sound = after.worst3 > 0 && after.worst3 >= std::min(before.worst3, cube(kLeastQuality));
    if (!is_sound || examine(judge_, change_, [&] { return Places{change_.star.at_goes}; }) != Verdict::kAccepted) {
        judge_.withdraw(change_);
        return false;
    }
    judge_.apply(change_);
    changed_ = change_.star.link;
    changed_.push_back(change_.star.goes);
    return true;
}

bool LengthSteps::try_collapse(FaceId f) {
    const auto lengths = lengths_of(f);
    const auto v = mesh_[f].vertices;
    std::array<int, 3> edges{0, 1, 2};
    std::sort(edges.begin(), edges.end(),
              [&](int n, int m) { return std::pair(lengths[n], n) < std::pair(lengths[m], m); });
    for (const int n : edges) {
        if (lengths[n] >= kShort) return false;
        const VertexId a = v[n], b = v[(n + 1) % 3];
        if (try_edge(a, b) || try_edge(b, a)) return true;
    }
    return false;
}

bool LengthSteps::try_edge(VertexId goes, VertexId stays) {
    if (mesh_[goes].is_fixed || mesh_[stays].is_fixed || mesh_[goes].label_count > mesh_[stays].label_count)
        return false;
    gather(mesh_, goes, stays, change_.star);
    if (topology_verdict(judge_, change_) != Verdict::kAccepted) return false;
    const EdgeStar& star = change_.star;
    const bool is_alike =
        mesh_[goes].label_count == mesh_[stays].label_count && mesh_[goes].sides == mesh_[stays].sides;
    if (!is_alike) return try_place(star.at_stays);
    // Where the surface is as good as flat in the middle, else at the end that keeps it, as on the edge of a solid.
    const Vec3 middle = 0.5 * (star.at_goes + star.at_stays);
    if (step_to(star, middle) <= height_ / 2 && try_place(middle)) return true;
    const bool keeps_goes = step_to(star, star.at_goes) < step_to(star, star.at_stays);
    return try_place(keeps_goes ? star.at_goes : star.at_stays) || try_place(keeps_goes ? star.at_stays : star.at_goes);
}

/// The edges from both ends before, and from the merged vertex at p after: is one of those long? Where the edge is
/// shorter than any wanted, they may be a little long, to be split, where that brings all nearer to the wanted length.
bool LengthSteps::makes_long(Vec3 p) const {
    const EdgeStar& star = change_.star;
    double longest = 0;
    for (const VertexId w : star.link) longest = std::max(longest, length_of(p, mesh_.position(w)));
    if (longest <= kLong) return false;
    if (longest > kLongest || length_of(star.at_goes, star.at_stays) >= kLeastOfLength) return true;
    double before = length_energy(length_of(star.at_goes, star.at_stays));
    for (const VertexId end : {star.goes, star.stays})
        before += energy_of_edges(end, end == star.goes ? star.stays : star.goes);
    return spoke_energy(p) >= before;
}

bool LengthSteps::try_place(Vec3 p) {
    const EdgeStar& star = change_.star;
    if (makes_long(p)) return false;
    FanShape before, after;
    for (int n = 0; n < star.face_count(); ++n) {
        before.add(star.at_apex(n), star.at_a(n), star.at_b(n));
        after.add(p, star.at_a(n), star.at_b(n));
    }
    if (!is_fair(before, after) || verdict_at(judge_, change_, {p}) != Verdict::kAccepted) return false;
    changed_ = star.link;
    changed_.push_back(star.stays);
    judge_.apply(change_);
    return true;
}

/// How far the faces of the interface round v, `change` more than there are, are from as many as its angle there holds
/// equilateral ones: six inside, three beside a straight line. Squared.
double LengthSteps::valence_excess(VertexId v, const std::array<Label, 2>& labels, int change) const {
    const bool is_inside = mesh_[v].label_count == 2;
    int count = change;
    double angle = 0;
    mesh_.for_star(v, [&](FaceId f, int place) {
        if (!is_inside && !mesh_[f].has_labels(labels)) return;
        ++count;
        if (is_inside) return;
        const auto& corners = mesh_[f].vertices;
        angle += angle_at(mesh_.position(v), mesh_.position(corners[place_after(place)]),
                          mesh_.position(corners[place_before(place)]));
    });
    const double ideal = is_inside ? 6 : std::max(1.0, std::round(angle * 3 / std::numbers::pi));
    return (count - ideal) * (count - ideal);
}

bool LengthSteps::try_flip(FaceId f, int place) {
    const std::optional<Flip> flip = find_flip(mesh_, f, place);
    if (!flip || flip->c == flip->d) return false;
    for (const VertexId v : {flip->u, flip->v, flip->c, flip->d})
        if (mesh_[v].is_fixed) return false;
    const auto labels = mesh_[f].labels;
    double gain = 0;
    for (const VertexId v : {flip->u, flip->v}) gain += valence_excess(v, labels, 0) - valence_excess(v, labels, -1);
    for (const VertexId v : {flip->c, flip->d}) gain += valence_excess(v, labels, 0) - valence_excess(v, labels, 1);
    if (gain < 0) return false;
    const Vec3 u = mesh_.position(flip->u), v = mesh_.position(flip->v), c = mesh_.position(flip->c),
               d = mesh_.position(flip->d);
    FanShape before, after;
    before.add(c, u, v);
    before.add(d, v, u);
    after.add(c, u, d);
    after.add(c, d, v);
    const bool is_better = gain > 0 ? is_fair(before, after) : after.is_better_than(before);
    if (!is_better || (length_of(c, d) > kLong && length_of(c, d) > length_of(u, v))) return false;
    if (!propose_flip(mesh_, *flip, change_) || change_.flip_error.height > height_ ||
        examine(judge_, change_, [&] { return Places{c}; }) != Verdict::kAccepted)
        return false;
    judge_.apply(change_);
    changed_ = {flip->u, flip->v, flip->c, flip->d};
    return true;
}

bool LengthSteps::try_move(VertexId v) {
    const Vertex& vertex = mesh_[v];
    if (!vertex.is_alive || vertex.is_fixed || vertex.star == kNoCorner || vertex.label_count > 3) return false;
    gather_move(mesh_, v, change_.star);
    candidates_.clear();
    if (vertex.label_count == 3) return try_line_move();
    return change_.star.is_interface && try_interface_move();
}

double LengthSteps::spoke_energy(Vec3 p) const {
    double energy = 0;
    for (const VertexId w : change_.star.link) energy += length_energy(length_of(p, mesh_.position(w)));
    return energy;
}

/// Of the edges from v, but for that to `other`.
double LengthSteps::energy_of_edges(VertexId v, VertexId other) const {
    double energy = 0;
    const Vec3 at = mesh_.position(v);
    // Each edge inside an interface comes twice, once in either face.
    mesh_.for_star(v, [&](FaceId f, int place) {
        const auto& corners = mesh_[f].vertices;
        for (const VertexId w : {corners[place_after(place)], corners[place_before(place)]})
            if (w != other) energy += 0.5 * length_energy(length_of(at, mesh_.position(w)));
    });
    return energy;
}

double LengthSteps::line_energy(Vec3 p) const {
    double energy = 0;
    for (const VertexId w : line_ends_) energy += length_energy(length_of(p, mesh_.position(w)));
    return energy;
}

/// Along the two edges of the line: their lengths alone count, as if the line were a mesh of its own.
bool LengthSteps::try_line_move() {
    gather_line_ends(mesh_, change_.star, line_ends_);
    if (line_ends_.size() != 2) return false;
    const Vec3 at = change_.star.at_goes;
    for (int n = 0; n < 2; ++n) {
        const Vec3 end = mesh_.position(line_ends_[n]), other = mesh_.position(line_ends_[1 - n]);
        for (const double share : kLineSteps) {
            const Vec3 p = at + share * (end - at), along = other - p;
            const double to_foot = std::clamp(dot(at - p, along) / length2(along), 0.0, 1.0);
            if (length(at - (p + to_foot * along)) <= height_) candidates_.push_back({p, line_energy(p)});
        }
    }
    return take_best(line_energy(at));
}

/// Where springs of the wanted length from the vertices of the link would pull the vertex, on average.
Vec3 LengthSteps::spring_target() const {
    const Vec3 at = change_.star.at_goes;
    Vec3 sum;
    for (const VertexId w : change_.star.link) {
        const Vec3 end = mesh_.position(w);
        const double x = length_of(end, at);
        sum += x > 0 ? end + (at - end) / x : at;
    }
    return sum / static_cast<double>(change_.star.link.size());
}

bool LengthSteps::try_interface_move() {
    const EdgeStar& star = change_.star;
    const Vec3 at = star.at_goes;
    Vec3 up, middle;
    double areas = 0;
    for (int n = 0; n < star.face_count(); ++n) {
        const Vec3 a = star.at_a(n), b = star.at_b(n), normal = area_vector(at, a, b);
        up += normal;
        middle += (length(normal) / 3) * (at + a + b);
        areas += length(normal);
    }
    const double up_size = length(up);
    if (up_size == 0) return false;
    for (const Vec3 target : {middle / areas, spring_target()})
        for (const double share : kSteps) {
            const auto p = point_on_star(star, at, at + share * (target - at), up);
            if (!p) continue;
            const auto old = point_on_star(star, *p, at, up);
            if (old && std::abs(dot(up, *old - at)) <= height_ * up_size) candidates_.push_back({*p, spoke_energy(*p)});
        }
    return take_best(spoke_energy(at));
}

bool LengthSteps::take_best(double now) {
    const EdgeStar& star = change_.star;
    std::sort(candidates_.begin(), candidates_.end(),
              [](const Candidate& a, const Candidate& b) { return a.energy < b.energy; });
    FanShape before;
    for (int n = 0; n < star.face_count(); ++n) before.add(star.at_goes, star.at_a(n), star.at_b(n));
    std::size_t tested = 0;
    for (const Candidate& best : candidates_) {
        if (best.energy >= kWorthMove * now || best.energy > now - kLeastGain || tested == kAttempts) return false;
        FanShape after;
        for (int n = 0; n < star.face_count(); ++n) after.add(best.at, star.at_a(n), star.at_b(n));
        if (!is_fair(before, after)) continue;
        ++tested;
        if (verdict_at(judge_, change_, {best.at}) != Verdict::kAccepted) continue;
        changed_ = star.link;
        changed_.push_back(star.goes);
        judge_.apply(change_);
        return true;
    }
    return false;
}

}  // namespace regionmesh
