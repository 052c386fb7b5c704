#include "judge/verdict/verdicts.h"

#include <utility>

namespace regionmesh {
namespace {

constexpr bool is_in_order() {
    for (std::size_t n = 0; n < kVerdictRows.size(); ++n)
        if (static_cast<std::size_t>(kVerdictRows[n].verdict) != n + 1) return false;
    return kVerdictRows.size() + 1 == kVerdictCount;
}
static_assert(is_in_order(), "a row for each verdict, in the order of their names");

/// Unrolled: the tests are called directly.
template <VerdictStep kStep>
Verdict first_refusal(const Judge& judge, Change& change) {
    Verdict verdict = Verdict::kAccepted;
    const auto passes = [&]<std::size_t kRow>() {
        if constexpr (kVerdictRows[kRow].step == kStep) verdict = kVerdictRows[kRow].test(judge, change);
        return verdict == Verdict::kAccepted;
    };
    [&]<std::size_t... kRow>(std::index_sequence<kRow...>) { (void)(passes.template operator()<kRow>() && ...); }
    (std::make_index_sequence<kVerdictRows.size()>());
    return verdict;
}

}  // namespace

Verdict topology_verdict(const Judge& judge, Change& change) {
    return first_refusal<VerdictStep::kTopology>(judge, change);
}

Verdict shape_verdict(const Judge& judge, Change& change, Vec3 position) {
    change.position = position;
    set_normals(change.star, position);
    return first_refusal<VerdictStep::kShape>(judge, change);
}

Verdict verdict_at(const Judge& judge, Change& change, const Places& places) {
    Verdict verdict = shape_verdict(judge, change, places.first);
    if (places.second) {
        const double worst3 = change.worst_quality3;
        const Verdict other = shape_verdict(judge, change, *places.second);
        if (other == Verdict::kAccepted && (verdict != Verdict::kAccepted || change.worst_quality3 > worst3)) {
            verdict = other;
        } else {
            change.position = places.first;
            change.worst_quality3 = worst3;
            set_normals(change.star, places.first);
        }
    }
    if (verdict != Verdict::kAccepted) return verdict;
    note_flat(change.star, change.position);
    verdict = first_refusal<VerdictStep::kSurroundings>(judge, change);
    if (verdict == Verdict::kAccepted) find_error(judge, change);
    return verdict;
}

}  // namespace regionmesh
