#include "judge/verdict/verdicts.h"

#include <utility>

namespace regionmesh {
namespace {

/// A test of one step may rely on the steps before.
enum class Step { kTopology, kShape, kSurroundings };

struct Row {
    Verdict verdict;
    Step step;
    Verdict (*test)(Collapse&);
};

/// Cheap tests first.
constexpr std::array kRows{
    Row{Verdict::kStrata, Step::kTopology, test_strata},
    Row{Verdict::kLink, Step::kTopology, test_link},
    Row{Verdict::kFold, Step::kShape, test_fold},
    Row{Verdict::kQuality, Step::kShape, test_quality},
    Row{Verdict::kPinch, Step::kShape, test_pinch},
    Row{Verdict::kError, Step::kSurroundings, test_error},
    Row{Verdict::kSamples, Step::kSurroundings, test_samples},
    Row{Verdict::kIntersect, Step::kSurroundings, test_intersect},
};

constexpr bool is_in_order() {
    for (std::size_t n = 0; n < kRows.size(); ++n)
        if (static_cast<std::size_t>(kRows[n].verdict) != n + 1) return false;
    return kRows.size() + 1 == kVerdictCount;
}
static_assert(is_in_order(), "a row for each verdict, in the order of their names");

/// Unrolled: the tests are called directly.
template <Step kStep>
Verdict first_refusal(Collapse& collapse) {
    Verdict verdict = Verdict::kAccepted;
    const auto passes = [&]<std::size_t kRow>() {
        if constexpr (kRows[kRow].step == kStep) verdict = kRows[kRow].test(collapse);
        return verdict == Verdict::kAccepted;
    };
    [&]<std::size_t... kRow>(std::index_sequence<kRow...>) { (void)(passes.template operator()<kRow>() && ...); }
    (std::make_index_sequence<kRows.size()>());
    return verdict;
}

}  // namespace

Verdict topology_verdict(Collapse& collapse) { return first_refusal<Step::kTopology>(collapse); }

Verdict shape_verdict(Collapse& collapse, Vec3 position) {
    collapse.position = position;
    set_normals(collapse.star, position);
    return first_refusal<Step::kShape>(collapse);
}

Verdict verdict_at(Collapse& collapse, const Places& places) {
    Verdict verdict = shape_verdict(collapse, places.first);
    if (places.second) {
        const double worst3 = collapse.worst_quality3;
        const Verdict other = shape_verdict(collapse, *places.second);
        if (other == Verdict::kAccepted && (verdict != Verdict::kAccepted || collapse.worst_quality3 > worst3)) {
            verdict = other;
        } else {
            collapse.position = places.first;
            collapse.worst_quality3 = worst3;
            set_normals(collapse.star, places.first);
        }
    }
    if (verdict != Verdict::kAccepted) return verdict;
    note_flat(collapse.star, collapse.position);
    return first_refusal<Step::kSurroundings>(collapse);
}

}  // namespace regionmesh
