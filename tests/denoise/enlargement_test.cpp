#include "denoise/enlargement.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace regionmesh {
namespace {

/// Changes at the edges of coarse samples of `factor` fine ones; `more` anywhere.
std::vector<std::uint64_t> steps_of(double factor, double edge, std::size_t count, std::uint64_t more = 0) {
    std::vector<std::uint64_t> steps(count, more);
    for (std::size_t i = 1; i < count; ++i)
        if (std::floor((i - edge) / factor) != std::floor((i - 1 - edge) / factor)) steps[i] += 40 + i % 7;
    return steps;
}

TEST(Enlargement, is_found_with_its_edges) {
    for (const double factor : {1.5, 2.0, 3.0, 1.536, 3.07, 4.25})
        for (const double edge : {-0.5, -0.8, -1.1}) {
            const Enlargement found = find_enlargement(steps_of(factor, edge, 200));
            EXPECT_NEAR(found.factor, factor, 0.02) << factor << " " << edge;
            EXPECT_LT(found.first_edge, 0);
            EXPECT_GT(found.first_edge, -found.factor - 1e-9);
            // The same samples lie between the same edges.
            const auto again = steps_of(found.factor, found.first_edge, 200);
            const auto given = steps_of(factor, edge, 200);
            int differ = 0;
            for (std::size_t i = 8; i < 192; ++i) differ += (again[i] > 0) != (given[i] > 0);
            EXPECT_LE(differ, 2) << factor << " " << edge;
        }
}

TEST(Enlargement, is_none_where_labels_change_anywhere) {
    EXPECT_EQ(find_enlargement(std::vector<std::uint64_t>(100, 30)).factor, 1);
    EXPECT_EQ(find_enlargement(steps_of(2, -0.5, 100, 10)).factor, 1);
}

TEST(Enlargement, is_none_with_few_edges) {
    std::vector<std::uint64_t> steps(64);
    for (const std::size_t i : {10, 20, 30, 40}) steps[i] = 100;
    EXPECT_EQ(find_enlargement(steps).factor, 1);
}

}  // namespace
}  // namespace regionmesh
