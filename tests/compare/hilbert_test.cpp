#include "compare/hilbert.h"

#include <gtest/gtest.h>

#include <map>

namespace regionmesh {
namespace {

TEST(Hilbert, each_cell_along_the_curve_is_beside_the_one_before) {
    constexpr std::uint32_t kSize = 16;
    std::map<std::uint32_t, std::array<std::uint32_t, 3>> cells;
    for (std::uint32_t n = 0; n < kSize * kSize * kSize; ++n) {
        const std::array<std::uint32_t, 3> cell{n % kSize, n / kSize % kSize, n / kSize / kSize};
        cells[hilbert_key(cell)] = cell;
    }
    ASSERT_EQ(cells.size(), kSize * kSize * kSize);
    EXPECT_EQ(cells.rbegin()->first, kSize * kSize * kSize - 1) << "a part of the grid is a part of the curve";
    const std::array<std::uint32_t, 3>* before = nullptr;
    for (const auto& [key, cell] : cells) {
        int steps = 0;
        for (int axis = 0; before && axis < 3; ++axis)
            steps += std::abs(static_cast<int>(cell[axis]) - static_cast<int>((*before)[axis]));
        EXPECT_EQ(steps, before ? 1 : 0) << key;
        before = &cell;
    }
}

TEST(HilbertGrid, takes_boxes_without_extent_and_points_outside) {
    const HilbertGrid flat(Box{{1, 2, 3}, {1, 2, 3}}), grid(Box{{0, 0, 0}, {1, 1, 1}});
    EXPECT_EQ(flat.key({1, 2, 3}), 0u);
    EXPECT_EQ(grid.key({-5, -5, -5}), grid.key({0, 0, 0}));
    EXPECT_EQ(grid.key({7, 0, 0}), grid.key({1, 0, 0}));
}

}  // namespace
}  // namespace regionmesh
