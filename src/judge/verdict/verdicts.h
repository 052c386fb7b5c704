// The tests of a change, in one table.
#pragma once

#include <array>

#include "judge/judge.h"

namespace regionmesh {

/// The first test of the table that refuses a change gives its verdict. A test looks at the steps before its own as
/// done, and serves every kind of star (StarKind).
///   strata     the edge's label set equals that of the vertex that goes (P tests 3 and 4).
///   link       Lk(goes) and Lk(stays) meet in exactly Lk(edge), in the complex and in the network of lines (Dey et al.
///              1999; Vivodtzev et al. 2005); implies that the Euler characteristics stay (P test 5). No edge moves
///              onto an edge of the box. A flip joins no neighbours.
///   fold       no surviving face turns by more than the bound (P test 1).
///   quality    no changed face gets below the bound, unless the star had such faces: then no more, and none worse, or
///              fewer, and none much worse (kLeastOfWorst and kLeastOfBound in src/judge/tuning.h).
///   pinch      no two faces at an edge from the merged vertex come closer than the bound (P test 2).
///   error      no point gets farther from the surface that decimation was given than Promises::max_error, either way.
///   samples    every sample of Promises::samples stays in its region.
///   intersect  the new faces meet no other face, and the merged vertex stays within the limits (P test 6). Finds the
///              faces at the edges of the link, too, and so gives `pinch` where one of them comes too close.
Verdict test_strata(const Judge& judge, Change& change);
Verdict test_link(const Judge& judge, Change& change);
Verdict test_fold(const Judge& judge, Change& change);
Verdict test_quality(const Judge& judge, Change& change);
Verdict test_pinch(const Judge& judge, Change& change);
Verdict test_error(const Judge& judge, Change& change);
Verdict test_samples(const Judge& judge, Change& change);
Verdict test_intersect(const Judge& judge, Change& change);

/// A test of one step may rely on the steps before.
enum class VerdictStep { kTopology, kShape, kSurroundings };

struct VerdictRow {
    Verdict verdict;
    VerdictStep step;
    Verdict (*test)(const Judge&, Change&);
    bool is_cured_elsewhere;  // another position of the merged vertex may be accepted: worth a second choice
    StopReason stops;         // why decimation ended, where this kept it from its target
};

/// Cheap tests first; in the order of Verdict.
inline constexpr std::array kVerdictRows{
    VerdictRow{Verdict::kStrata, VerdictStep::kTopology, test_strata, false, StopReason::kTopology},
    VerdictRow{Verdict::kLink, VerdictStep::kTopology, test_link, false, StopReason::kTopology},
    VerdictRow{Verdict::kFold, VerdictStep::kShape, test_fold, true, StopReason::kTopology},
    VerdictRow{Verdict::kQuality, VerdictStep::kShape, test_quality, true, StopReason::kTopology},
    VerdictRow{Verdict::kPinch, VerdictStep::kShape, test_pinch, true, StopReason::kTopology},
    VerdictRow{Verdict::kError, VerdictStep::kSurroundings, test_error, false, StopReason::kMaxError},
    VerdictRow{Verdict::kSamples, VerdictStep::kSurroundings, test_samples, true, StopReason::kTopology},
    VerdictRow{Verdict::kIntersect, VerdictStep::kSurroundings, test_intersect, false, StopReason::kTopology},
};

/// May another position of the merged vertex be accepted?
constexpr bool is_cured_elsewhere(Verdict verdict) {
    return verdict != Verdict::kAccepted && kVerdictRows[static_cast<std::size_t>(verdict) - 1].is_cured_elsewhere;
}

/// Number of refusals that end decimation for this reason.
inline std::uint64_t count_of(StopReason reason, const VerdictCounts& counts) {
    std::uint64_t sum = 0;
    for (const VerdictRow& row : kVerdictRows)
        if (row.stops == reason) sum += counts[static_cast<std::size_t>(row.verdict)];
    return sum;
}

/// The tests that need the star only.
Verdict topology_verdict(const Judge& judge, Change& change);

/// The tests of shape at a position, which is noted with the normals and the worst quality.
Verdict shape_verdict(const Judge& judge, Change& change, Vec3 position);

/// All tests from shape on, at the better of the places. Where the change is accepted, Judge::apply may follow.
Verdict verdict_at(const Judge& judge, Change& change, const Places& places);

/// All tests in their order. `place()` gives the places, and is called where topology allows the change.
template <class Place>
Verdict examine(const Judge& judge, Change& change, Place&& place) {
    const Verdict verdict = topology_verdict(judge, change);
    return verdict == Verdict::kAccepted ? verdict_at(judge, change, place()) : verdict;
}

/// Finds the error bound of the merged vertex, where no largest one made test_error find it.
inline void find_error(const Judge& judge, Change& change) {
    if (judge.promises().max_error == HUGE_VAL && !change.is_flip())
        change.error.merged(judge.mesh(), change.star, change.position);
}

}  // namespace regionmesh
