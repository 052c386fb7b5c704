#include "judge/verdict/verdicts.h"

namespace regionmesh {

Verdict test_error(const Judge& judge, Change& change) {
    const double most = judge.promises().max_error;
    if (most == HUGE_VAL) return Verdict::kAccepted;
    const double bound =
        change.is_flip() ? change.flip_error.bound : change.error.merged(judge.mesh(), change.star, change.position);
    return is_within(bound, most) ? Verdict::kAccepted : Verdict::kError;
}

}  // namespace regionmesh
