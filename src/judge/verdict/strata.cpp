#include "mesh/strata.h"

#include "judge/verdict/verdicts.h"

namespace regionmesh {

Verdict test_strata(Collapse& collapse) {
    const EdgeStar& star = collapse.star;
    // All edges of a vertex of two labels have both; the prepass tries edges of the right stratum only.
    if (star.keeps_stays || collapse.mesh[star.goes].label_count == 2) return Verdict::kAccepted;
    const int edge_count = edge_labels(collapse.mesh, star.goes, star.stays).size();
    return edge_count == vertex_labels(collapse.mesh, star.goes).size() ? Verdict::kAccepted : Verdict::kStrata;
}

}  // namespace regionmesh
