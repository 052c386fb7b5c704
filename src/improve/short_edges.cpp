#include "improve/short_edges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "improve/fan_shape.h"
#include "judge/verdict/verdicts.h"

namespace regionmesh {

ShortEdges::ShortEdges(Judge& judge, SurfaceDrift& drift) : judge_(judge), mesh_(judge.mesh()), drift_(drift) {}

bool ShortEdges::try_collapse(FaceId f) {
    const auto v = mesh_[f].vertices;
    const auto length2_of = [&](int n) { return length2(mesh_.position(v[(n + 1) % 3]) - mesh_.position(v[n])); };
    std::array<int, 3> edges{0, 1, 2};
    std::sort(edges.begin(), edges.end(),
              [&](int n, int m) { return std::pair(length2_of(n), n) < std::pair(length2_of(m), m); });
    for (int n : edges) {
        const VertexId a = v[n], b = v[(n + 1) % 3];
        if (try_edge(a, b) || try_edge(b, a)) return true;
    }
    return false;
}

bool ShortEdges::try_edge(VertexId goes, VertexId stays) {
    if (mesh_[goes].is_fixed || mesh_[stays].is_fixed || mesh_[goes].label_count > mesh_[stays].label_count)
        return false;
    gather(mesh_, goes, stays, change_.star);
    if (topology_verdict(judge_, change_) != Verdict::kAccepted) return false;
    const EdgeStar& star = change_.star;
    if (try_place(star.at_stays)) return true;
    const bool is_alike =
        mesh_[goes].label_count == mesh_[stays].label_count && mesh_[goes].sides == mesh_[stays].sides;
    return is_alike && try_place(0.5 * (star.at_goes + star.at_stays));
}

bool ShortEdges::try_place(Vec3 p) {
    const EdgeStar& star = change_.star;
    FanShape before, after;
    for (int n = 0; n < star.face_count(); ++n) {
        before.add(star.at_apex(n), star.at_a(n), star.at_b(n));
        after.add(p, star.at_a(n), star.at_b(n));
    }
    for (FaceId f : star.dead) {
        const auto corners = mesh_.corners(f);
        before.add(corners[0], corners[1], corners[2]);
    }
    if (!after.is_better_than(before)) return false;
    float drift = std::max(drift_.of(star.goes), drift_.of(star.stays));
    for (VertexId w : star.link) drift = std::max(drift, drift_.of(w));
    const double step = step_to(star, p);
    if (!drift_.may_move(drift, step, true) || verdict_at(judge_, change_, {p}) != Verdict::kAccepted) return false;
    changed_ = star.link;
    changed_.push_back(star.stays);
    judge_.apply(change_);
    drift_.set(star.stays, drift, step);
    return true;
}

}  // namespace regionmesh
