#include "surface/bodies.h"

#include <algorithm>
#include <array>

#include "surface/shells.h"

namespace regionmesh {
namespace {

constexpr std::uint32_t kNone = 0xFFFFFFFFu;
constexpr std::size_t kFirstCandidates = 24;  // faces below which an inner point is sought, the deepest first

/// The distance, in units of `step`, from `from` to the point where the ray meets the face (Moeller and Trumbore 1997).
/// Double precision is enough to choose a candidate.
double distance_to(const std::array<Vec3, 3>& p, Vec3 from, Vec3 step) {
    const Vec3 e = p[1] - p[0], g = p[2] - p[0], h = cross(step, g);
    const double d = dot(e, h);
    if (d == 0) return HUGE_VAL;
    const Vec3 s = from - p[0], q = cross(s, e);
    const double u = dot(s, h) / d, v = dot(step, q) / d, t = dot(g, q) / d;
    constexpr double kSlack = 1e-9;  // a second hit on an edge is harmless, a missed one is not
    return u < -kSlack || v < -kSlack || u + v > 1 + kSlack || t <= 0 ? HUGE_VAL : t;
}

}  // namespace

Bodies::Bodies(const Mesh& mesh)
    : mesh_(mesh), tree_(mesh, 0), ray_(mesh, tree_), shells_(std::size_t{2} * mesh.face_end(), kNone) {
    make_bodies(list_shells());
}

/// Numbers the shells and returns which of them are open.
std::vector<bool> Bodies::list_shells() {
    UnionFind joined(2 * mesh_.face_end());
    const std::vector<bool> ends = join_sides(mesh_, joined);
    std::vector<bool> is_open;
    for (std::uint32_t f = 0; f < mesh_.face_end(); ++f) {
        if (!mesh_.is_alive(FaceId{f})) continue;
        for (FaceSide side = 2 * f; side < 2 * f + 2; ++side) {
            const std::uint32_t root = joined.find(side);  // the smallest of its set
            if (root == side) {
                shells_[side] = static_cast<std::uint32_t>(is_open.size());
                is_open.push_back(false);
                shell_starts_.push_back(0);
            }
            shells_[side] = shells_[root];
            if (ends[side]) is_open[shells_[side]] = true;
            ++shell_starts_[shells_[side]];
        }
    }
    std::uint32_t end = 0;
    for (std::uint32_t& start : shell_starts_) start = std::exchange(end, end + start);
    shell_starts_.push_back(end);
    sides_.resize(end);
    std::vector<std::uint32_t> next = shell_starts_;
    for (FaceSide side = 0; side < shells_.size(); ++side)
        if (shells_[side] != kNone) sides_[next[shells_[side]]++] = side;
    return is_open;
}

/// Positive for an outer shell. Measured from one of its own vertices, so that small shells far from the origin keep
/// their sign.
double Bodies::enclosed_volume(std::uint32_t shell) const {
    const Vec3 o = mesh_.corners(face_of(sides(shell)[0]))[0];
    double sixfold = 0;
    for (const FaceSide side : sides(shell)) {
        const auto p = mesh_.corners(face_of(side));
        const double cone = dot(p[0] - o, cross(p[1] - o, p[2] - o));
        sixfold += side % 2 == 0 ? cone : -cone;
    }
    return sixfold / 6;
}

/// Each outer shell makes a body; a cavity belongs to the innermost body of its label that contains it.
void Bodies::make_bodies(const std::vector<bool>& is_open) {
    shell_bodies_.assign(shell_count(), kNone);
    std::vector<double> volumes(shell_count());
    std::vector<std::uint32_t> cavities;
    const auto add_body = [&](std::uint32_t shell, bool is_bounded) {
        shell_bodies_[shell] = static_cast<std::uint32_t>(bodies_.size());
        bodies_.push_back({label_of_side(mesh_, sides(shell)[0]), is_bounded, volumes[shell], {shell}});
    };
    for (std::uint32_t shell = 0; shell < shell_count(); ++shell) {
        volumes[shell] = enclosed_volume(shell);
        if (is_open[shell] || volumes[shell] > 0)
            add_body(shell, !is_open[shell]);
        else
            cavities.push_back(shell);
    }
    std::vector<std::optional<std::uint32_t>> round;
    for (const std::uint32_t cavity : cavities) round.push_back(body_round(cavity));
    for (std::size_t n = 0; n < cavities.size(); ++n) {
        if (!round[n]) {
            add_body(cavities[n], false);
            continue;
        }
        shell_bodies_[cavities[n]] = *round[n];
        bodies_[*round[n]].shells.push_back(cavities[n]);
        bodies_[*round[n]].volume += volumes[cavities[n]];
    }
}

/// The smallest body of the cavity's label whose outer shell encloses it. Requires that bodies have outer shells only.
std::optional<std::uint32_t> Bodies::body_round(std::uint32_t cavity) const {
    const Label label = label_of_side(mesh_, sides(cavity)[0]);
    const auto body_at = [&](FaceSide side) {
        const std::uint32_t body = shell_bodies_[shells_[side]];
        return body != kNone && bodies_[body].is_bounded && bodies_[body].label == label ? body : kNone;
    };
    const auto is_wanted = [&](FaceId f) {
        return body_at(face_side(f, 0)) != kNone || body_at(face_side(f, 1)) != kNone;
    };
    std::optional<std::vector<FacePassed>> passed;
    for (const FaceSide side : sides(cavity)) {
        for (const Vec3 corner : mesh_.corners(face_of(side)))
            if (!passed) passed = ray_.faces_passed(corner, is_wanted);
        if (passed) break;
    }
    if (!passed) return std::nullopt;
    std::vector<std::pair<std::uint32_t, int>> times_round;
    for (const auto& [face, leaves_first] : *passed)
        for (int k = 0; k < 2; ++k)
            if (const std::uint32_t body = body_at(face_side(face, k)); body != kNone)
                times_round.emplace_back(body, (k == 0) == leaves_first ? 1 : -1);
    std::ranges::sort(times_round);
    std::optional<std::uint32_t> innermost;
    for (std::size_t n = 0; n < times_round.size();) {
        const std::uint32_t body = times_round[n].first;
        int sum = 0;
        for (; n < times_round.size() && times_round[n].first == body; ++n) sum += times_round[n].second;
        if (sum > 0 && (!innermost || bodies_[body].volume < bodies_[*innermost].volume)) innermost = body;
    }
    return innermost;
}

/// Is the point inside the outer shell and in none of the cavities?
bool Bodies::is_inside(Vec3 point, const Body& body) const {
    const std::uint32_t number = shell_bodies_[body.shells[0]];
    const auto is_of_body = [&](FaceSide side) { return shell_bodies_[shells_[side]] == number; };
    const auto passed =
        ray_.faces_passed(point, [&](FaceId f) { return is_of_body(face_side(f, 0)) || is_of_body(face_side(f, 1)); });
    if (!passed) return false;
    int sum = 0;
    for (const auto& [face, leaves_first] : *passed)
        for (int k = 0; k < 2; ++k)
            if (is_of_body(face_side(face, k))) sum += (k == 0) == leaves_first ? 1 : -1;
    return sum == 1;
}

/// The point halfway from the centroid of the face to the next face along the inward normal.
Bodies::Candidate Bodies::candidate_below(FaceSide side) const {
    const auto p = mesh_.corners(face_of(side));
    const Vec3 normal = cross(p[1] - p[0], p[2] - p[0]);
    const double twofold = length(normal);
    if (!(twofold > 0)) return {};
    const Vec3 from = (p[0] + p[1] + p[2]) / 3, step = (side % 2 == 0 ? -1 : 1) / twofold * normal;
    const double reach = 64 * std::sqrt(twofold);  // a longer ray would cost too much
    double nearest = reach;
    for (double length = std::sqrt(twofold); nearest == reach && length <= reach; length *= 2) {
        Box box;
        box.add(from);
        box.add(from + length * step);
        tree_.search(box, [&](FaceId f) {
            if (f != face_of(side)) nearest = std::min(nearest, distance_to(mesh_.corners(f), from, step));
            return true;
        });
    }
    return {from + 0.5 * nearest * step, 0.5 * nearest};
}

std::optional<Vec3> Bodies::point_inside(const Body& body) const {
    const auto outer = sides(body.shells[0]);
    std::vector<Candidate> candidates;
    const std::size_t stride = std::max<std::size_t>(1, outer.size() / kFirstCandidates);
    for (std::size_t n = 0; n < outer.size(); n += stride) candidates.push_back(candidate_below(outer[n]));
    std::ranges::stable_sort(candidates, std::ranges::greater(), &Candidate::depth);
    for (const Candidate& candidate : candidates)
        if (candidate.depth > 0 && is_inside(candidate.point, body)) return candidate.point;
    for (const FaceSide side : outer)
        if (const Candidate candidate = candidate_below(side); candidate.depth > 0 && is_inside(candidate.point, body))
            return candidate.point;
    return std::nullopt;
}

}  // namespace regionmesh
