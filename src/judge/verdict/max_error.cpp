#include "judge/verdict/verdicts.h"

namespace regionmesh {

Verdict test_error(Collapse& collapse) {
    if (collapse.max_error == HUGE_VAL) return Verdict::kAccepted;
    const double bound = collapse.error.merged(collapse.mesh, collapse.star, collapse.position);
    return is_within(bound, collapse.max_error) ? Verdict::kAccepted : Verdict::kError;
}

}  // namespace regionmesh
