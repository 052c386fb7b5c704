#include <algorithm>
#include <cmath>

#include "base/triangle.h"
#include "judge/verdict/verdicts.h"

namespace regionmesh {
namespace {

/// The star of a flip has the place of its second face alone before the flip.
bool turns_first_face(const Judge& judge, const Change& change) {
    const auto f = judge.mesh().corners(change.flip.f);
    const Vec3 normal = area_vector(f[0], f[1], f[2]);
    const double bound = judge.bounds().min_turn_cosine * length(normal);
    const EdgeStar& star = change.star;
    for (int n = 0; n < star.face_count(); ++n)
        if (!(dot(normal, star.new_normal(n)) > bound * length(star.new_normal(n)))) return true;
    return false;
}

}  // namespace

Verdict test_fold(const Judge& judge, Change& change) {
    unsigned kept = 3;
    for (const StarPair& pair : change.star.pairs)
        kept &= bits_of(keep_direction(pair.old_normal, pair.old_length2, pair.new_normal, pair.new_length2,
                                       judge.bounds().min_turn_cosine));
    if (kept != 3) return Verdict::kFold;
    return change.is_flip() && turns_first_face(judge, change) ? Verdict::kFold : Verdict::kAccepted;
}

}  // namespace regionmesh
