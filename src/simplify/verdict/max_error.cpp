#include "simplify/verdict/verdicts.h"

namespace regionmesh {

Verdict test_error(Collapse& collapse) {
    if (collapse.max_error == HUGE_VAL) return Verdict::kAccepted;
    Vertex merged;  // whose bound is rounded up
    merged.set_error_bound(collapse.error.merged(collapse.mesh, collapse.star, collapse.position));
    return merged.error_bound() <= collapse.max_error ? Verdict::kAccepted : Verdict::kError;
}

}  // namespace regionmesh
