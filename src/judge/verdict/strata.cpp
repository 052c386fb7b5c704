#include "mesh/strata.h"

#include "judge/verdict/verdicts.h"

namespace regionmesh {

Verdict test_strata(const Judge& judge, Change& change) {
    const Mesh& mesh = judge.mesh();
    const EdgeStar& star = change.star;
    // All edges of a vertex of two labels have both; halves, moves and flips are proposed in the right stratum only.
    if (star.kind != StarKind::kCollapse || mesh[star.goes].label_count == 2) return Verdict::kAccepted;
    const int edge_count = edge_labels(mesh, star.goes, star.stays).size();
    return edge_count == vertex_labels(mesh, star.goes).size() ? Verdict::kAccepted : Verdict::kStrata;
}

}  // namespace regionmesh
