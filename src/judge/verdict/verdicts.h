// The tests of a collapse, in one table.
#pragma once

#include "regionmesh/verdict.h"
#include "judge/judge.h"

namespace regionmesh {

/// The first test of the table that refuses a collapse gives its verdict. A row is {verdict, step, test};
/// CONTRIBUTING.md says what a new one needs. A test looks at the steps before its own as done, and serves both kinds
/// of star: that of both ends, and that of `goes` alone, where `stays` does not move (EdgeStar::keeps_stays).
///   strata     the edge's label set equals that of the vertex that goes (P tests 3 and 4).
///   link       Lk(goes) and Lk(stays) meet in exactly Lk(edge), in the complex and in the network of lines (Dey et al.
///              1999; Vivodtzev et al. 2005); implies that the Euler characteristics stay (P test 5). No edge moves
///              onto an edge of the box.
///   fold       no surviving face turns by more than the bound (P test 1).
///   quality    no changed face gets below the bound, unless the star had such faces: then no more, and none worse, or
///              fewer, and none much worse (kLeastOfWorst and kLeastOfBound in src/simplify/tuning.h).
///   pinch      no two faces at an edge from the merged vertex come closer than the bound (P test 2).
///   error      no point gets farther from the surface that decimation was given than Collapse::max_error, either way.
///   samples    every sample of Collapse::samples stays in its region.
///   intersect  the new faces meet no other face, and the merged vertex stays within the limits (P test 6). Finds the
///              faces at the edges of the link, too, and so gives `pinch` where one of them comes too close.
Verdict test_strata(Collapse& collapse);
Verdict test_link(Collapse& collapse);
Verdict test_fold(Collapse& collapse);
Verdict test_quality(Collapse& collapse);
Verdict test_pinch(Collapse& collapse);
Verdict test_error(Collapse& collapse);
Verdict test_samples(Collapse& collapse);
Verdict test_intersect(Collapse& collapse);

/// The tests that need the star only.
Verdict topology_verdict(Collapse& collapse);

/// The tests of shape at a position, which is noted with the normals and the worst quality.
Verdict shape_verdict(Collapse& collapse, Vec3 position);

/// All tests from shape on, at the better of the places.
Verdict verdict_at(Collapse& collapse, const Places& places);

/// All tests in their order. `place()` gives the places, and is called where topology allows the collapse. Where it is
/// accepted, collapse_edge may follow.
template <class Place>
Verdict examine(Collapse& collapse, Place&& place) {
    Verdict verdict = topology_verdict(collapse);
    if (verdict == Verdict::kAccepted) verdict = verdict_at(collapse, place());
    if (verdict == Verdict::kAccepted) find_error(collapse);
    return verdict;
}

}  // namespace regionmesh
