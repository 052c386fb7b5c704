// Volumes and the largest error together.
#include <gtest/gtest.h>

#include "regionmesh/check.h"
#include "regionmesh/reconstruct.h"
#include "support/runs.h"

namespace regionmesh {
namespace {

TEST(PreserveWithin, the_step_of_volumes_stays_within_the_largest_error) {
    for (const double max_error : {0.05, 0.2}) {
        SCOPED_TRACE(max_error);
        test::ArrayVolume volume = test::grain_volume({7, 6, 5}, 6, 2);
        const Reconstruction made = test::run(
            volume, {.promises = {.max_error = max_error}, .preserve_volume = true, .background = {}, .threads = 1});
        EXPECT_GT(made.report.preserved.rounds, 0u);
        EXPECT_LE(made.report.error_bound, max_error);
        EXPECT_LT(made.report.preserved.drift, made.report.preserved.drift_before);
        test::expect_sound(made.report.check);
    }
}

}  // namespace
}  // namespace regionmesh
