#include <algorithm>
#include <span>

#include "judge/verdict/verdicts.h"

namespace regionmesh {
namespace {

/// Does the merged vertex stay strictly inside the limits, but for the coordinates that sides of the box hold?
bool is_within_limits(const Judge& judge, const Change& change) {
    const Vec3 p = change.position;
    for (int axis = 0; axis < 3; ++axis) {
        if (judge.mesh()[change.star.stays].sides >> (2 * axis) & 3) continue;
        if (!(judge.limits().low[axis] < p[axis] && p[axis] < judge.limits().high[axis])) return false;
    }
    return true;
}

/// Would a face between two regions come to lie in a side of the box? A side without caps (open, or background) has no
/// faces that it would meet, and flat stars are not searched: there it could later overlap other such faces.
bool lies_down_on_side(const Mesh& mesh, const EdgeStar& star) {
    const SideSet stays = mesh[star.stays].sides & kBoxSides;
    if (stays == 0) return false;
    return std::any_of(star.faces.begin(), star.faces.end(), [&](const StarFace& f) {
        const auto& labels = mesh[f.face].labels;
        return (stays & mesh[f.a].sides & mesh[f.b].sides) != 0 && !is_exterior(labels[0]) && !is_exterior(labels[1]);
    });
}

}  // namespace

Verdict test_intersect(const Judge& judge, Change& change) {
    const Mesh& mesh = judge.mesh();
    const EdgeStar& star = change.star;
    // A vertex that stays where it is adds nothing beyond the limits, which are convex.
    if (!star.keeps_stays && !is_within_limits(judge, change)) return Verdict::kIntersect;
    const std::span<const FaceId> gone = change.replaces_others() ? std::span(change.gone) : std::span<const FaceId>();
    Verdict verdict = Verdict::kAccepted;
    if (judge.tree())
        verdict =
            change.intersect.verdict(mesh, *judge.tree(), judge.rising(), star, change.position, judge.bounds(), gone);
    else if (pinches_around(mesh, star, change.position, judge.bounds(), gone))
        verdict = Verdict::kPinch;
    return verdict == Verdict::kAccepted && lies_down_on_side(mesh, star) ? Verdict::kIntersect : verdict;
}

}  // namespace regionmesh
