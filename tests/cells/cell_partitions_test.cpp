// All 4,140 ways to part the eight corners of one cell.
#include <gtest/gtest.h>

#include <algorithm>

#include "support/runs.h"
#include "support/strata_list.h"

namespace regionmesh {
namespace {

using Corners = std::vector<InputLabel>;

/// Each corner has a label of an earlier one, or the first that is new.
template <class Visit>
void for_partitions(Corners& labels, InputLabel fresh, Visit&& visit) {
    if (labels.size() == 8) return visit(labels);
    for (InputLabel label = 0; label <= fresh; ++label) {
        labels.push_back(label);
        for_partitions(labels, std::max(fresh, label + 1), visit);
        labels.pop_back();
    }
}

template <class Visit>
void for_partitions(Visit&& visit) {
    Corners labels;
    for_partitions(labels, 0, visit);
}

std::string text_of(const Corners& labels) {
    std::string text;
    for (InputLabel label : labels) text += std::to_string(label);
    return text;
}

TEST(CellPartitions, there_are_4140) {
    int count = 0;
    for_partitions([&](const Corners&) { ++count; });
    EXPECT_EQ(count, 4140);
}

TEST(CellPartitions, each_is_closed_generic_and_as_its_labels_say) {
    for_partitions([](const Corners& labels) {
        if (testing::Test::HasFailure()) return;
        SCOPED_TRACE("corners " + text_of(labels));
        const Reconstruction made = test::run(test::ArrayVolume({2, 2, 2}, labels));
        test::expect_sound(made.report.check);
        test::expect_generic(made.mesh);
        EXPECT_GT(made.report.check.quality.min, 0.138);
        double volume = 0;
        for (const RegionReport& region : made.report.check.regions) volume += region.volume;
        EXPECT_NEAR(volume, 1, 1e-12);
    });
}

TEST(CellPartitions, each_keeps_its_strata_when_decimated) {
    int n = 0;
    for_partitions([&](const Corners& labels) {
        if (testing::Test::HasFailure() || ++n % 3) return;
        SCOPED_TRACE("corners " + text_of(labels));
        test::ArrayVolume cell({2, 2, 2}, labels);
        const Reconstruction made = test::run(cell, test::reduced(1));
        test::expect_sound(made.report.check);
        test::expect_same_strata(test::list_strata(made.mesh), test::list_strata(test::run(cell).mesh));
    });
}

}  // namespace
}  // namespace regionmesh
