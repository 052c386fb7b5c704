#include "improve/edge_splits.h"

#include <algorithm>
#include <array>

#include "improve/fan_shape.h"
#include "judge/verdict/verdicts.h"

namespace regionmesh {
namespace {

/// Least share of the edge on either side of the new vertex.
constexpr double kLeastPart = 0.15;

int place_of_longest_edge(const std::array<Vec3, 3>& p) {
    int longest = 0;
    for (int n = 1; n < 3; ++n)
        if (length2(p[(n + 1) % 3] - p[n]) > length2(p[(longest + 1) % 3] - p[longest])) longest = n;
    return longest;
}

}  // namespace

bool EdgeSplits::try_split(FaceId f) {
    const auto corners = mesh_[f].vertices;
    const auto p = mesh_.corners(f);
    const int n = place_of_longest_edge(p);
    const VertexId u = corners[n], v = corners[(n + 1) % 3];
    if (mesh_[u].is_fixed || mesh_[v].is_fixed) return false;
    judge_.propose_split(u, v, change_);
    drift_.grow(mesh_.vertex_end());
    const EdgeStar& star = change_.star;
    FanShape before;
    for (const FaceId old : change_.gone) {
        const auto q = mesh_.corners(old);
        before.add(q[0], q[1], q[2]);
    }
    const Vec3 along = p[(n + 1) % 3] - p[n];
    const double foot = std::clamp(dot(p[(n + 2) % 3] - p[n], along) / length2(along), kLeastPart, 1 - kLeastPart);
    for (const Vec3 at : {p[n] + foot * along, star.at_goes}) {
        FanShape after;
        for (int face = 0; face < star.face_count(); ++face) after.add(at, star.at_a(face), star.at_b(face));
        if (!after.is_better_than(before) || examine(judge_, change_, [&] { return Places{at}; }) != Verdict::kAccepted)
            continue;
        const float drift = std::max(drift_.of(u), drift_.of(v));
        judge_.apply(change_);
        drift_.set(star.goes, drift, 0);
        return true;
    }
    judge_.withdraw(change_);
    return false;
}

}  // namespace regionmesh
