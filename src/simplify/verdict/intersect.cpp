#include "simplify/verdict/verdicts.h"

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

}  // namespace

Verdict test_intersect(Collapse& collapse) {
    // A vertex that stays where it is adds nothing beyond the limits, which are convex.
    if (!collapse.star.keeps_stays && !is_within_limits(collapse)) return Verdict::kIntersect;
    if (collapse.tree)
        return collapse.intersect.verdict(collapse.mesh, *collapse.tree, collapse.rising, collapse.star,
                                          collapse.position, collapse.bounds);
    return pinches_around(collapse.mesh, collapse.star, collapse.position, collapse.bounds) ? Verdict::kPinch
                                                                                            : Verdict::kAccepted;
}

}  // namespace regionmesh
