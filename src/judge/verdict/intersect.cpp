#include <algorithm>

#include "judge/verdict/verdicts.h"

namespace regionmesh {
namespace {

/// Does the merged vertex stay strictly inside the limits, but for the coordinates that sides of the box hold?
bool is_within_limits(const Collapse& collapse) {
    const Vec3 p = collapse.position;
    for (int axis = 0; axis < 3; ++axis) {
        if (collapse.mesh[collapse.star.stays].sides >> (2 * axis) & 3) continue;
        if (!(collapse.limits.low[axis] < p[axis] && p[axis] < collapse.limits.high[axis])) return false;
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

Verdict test_intersect(Collapse& collapse) {
    // A vertex that stays where it is adds nothing beyond the limits, which are convex.
    if (!collapse.star.keeps_stays && !is_within_limits(collapse)) return Verdict::kIntersect;
    const Verdict verdict =
        collapse.tree ? collapse.intersect.verdict(collapse.mesh, *collapse.tree, collapse.rising, collapse.star,
                                                   collapse.position, collapse.bounds)
        : pinches_around(collapse.mesh, collapse.star, collapse.position, collapse.bounds) ? Verdict::kPinch
                                                                                           : Verdict::kAccepted;
    return verdict == Verdict::kAccepted && lies_down_on_side(collapse.mesh, collapse.star) ? Verdict::kIntersect
                                                                                            : verdict;
}

}  // namespace regionmesh
