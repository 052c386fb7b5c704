#include "smooth/region_matrix.h"

#include <gtest/gtest.h>

#include <random>

namespace regionmesh {
namespace {

TEST(RegionMatrix, solves_what_it_holds) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> value(-1, 1);
    constexpr std::uint32_t kSize = 12;
    double dense[kSize][kSize] = {};
    RegionMatrix matrix(kSize);
    for (int n = 0; n < 40; ++n) {  // sums of squares are positive definite
        double g[kSize];
        for (double& x : g) x = value(random);
        for (std::uint32_t i = 0; i < kSize; ++i)
            for (std::uint32_t j = i; j < kSize; ++j) {
                matrix.add(j, i, g[i] * g[j]);
                dense[i][j] += g[i] * g[j];
                if (i != j) dense[j][i] += g[i] * g[j];
            }
    }
    std::vector<double> b(kSize);
    for (double& x : b) x = value(random);
    const std::vector<double> x = matrix.solve(b);
    for (std::uint32_t i = 0; i < kSize; ++i) {
        double sum = 0;
        for (std::uint32_t j = 0; j < kSize; ++j) sum += dense[i][j] * x[j];
        EXPECT_NEAR(sum, b[i], 1e-9);
    }
}

TEST(RegionMatrix, finds_a_solution_where_it_is_singular) {
    // A ring of regions that only exchange volume: adding the same to all of them changes nothing.
    RegionMatrix matrix(4);
    for (std::uint32_t n = 0; n < 4; ++n) {
        matrix.add(n, n, 2);
        matrix.add(n, (n + 1) % 4, -1);
    }
    const std::vector<double> b{3, -1, 0, -2};
    const std::vector<double> x = matrix.solve(b);
    for (std::size_t n = 0; n < 4; ++n) EXPECT_NEAR(2 * x[n] - x[(n + 1) % 4] - x[(n + 3) % 4], b[n], 1e-10);
}

TEST(RegionMatrix, leaves_empty_rows_out) {
    RegionMatrix matrix(3);
    matrix.add(0, 0, 2);
    matrix.add(2, 2, 4);
    EXPECT_EQ(matrix.solve({2, 5, 8}), (std::vector<double>{1, 0, 2}));
}

}  // namespace
}  // namespace regionmesh
