#include "judge/verdict/verdicts.h"

namespace regionmesh {

Verdict test_fold(Collapse& collapse) {
    unsigned kept = 3;
    for (const StarPair& pair : collapse.star.pairs)
        kept &= bits_of(keep_direction(pair.old_normal, pair.old_length2, pair.new_normal, pair.new_length2,
                                       collapse.bounds.min_turn_cosine));
    return kept == 3 ? Verdict::kAccepted : Verdict::kFold;
}

}  // namespace regionmesh
