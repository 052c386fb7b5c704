#include "simplify/tiles/tile_grid.h"

#include <gtest/gtest.h>

namespace regionmesh {
namespace {

TileGrid shifted() {
    return {.origin = {1, 2, 3}, .spacing = {1, 0.5, 2}, .size = {10, 7, 4}, .cells = {4, 4, 4}, .shift = {2, 0, 1}};
}

TEST(TileGrid, covers_the_volume) {
    const TileGrid grid = shifted();
    EXPECT_EQ(grid.count(0), 3u);  // 2, 4, 4 cells
    EXPECT_EQ(grid.count(1), 2u);  // 4, 3
    EXPECT_EQ(grid.count(2), 2u);  // 3, 1
    double volume = 0;
    for (std::uint32_t tile = 0; tile < grid.tile_count(); ++tile) {
        const Vec3 extent = grid.limits(tile).high - grid.limits(tile).low;
        volume += extent.x * extent.y * extent.z;
    }
    EXPECT_EQ(volume, 10 * 3.5 * 8);
}

TEST(TileGrid, finds_the_tile_of_a_point) {
    const TileGrid grid = shifted();
    for (double x = 1.25; x < 11; x += 0.5)
        for (double y = 2.25; y < 5.5; y += 0.5)
            for (double z = 3.25; z < 11; z += 0.5) {
                const Box limits = grid.limits(grid.tile_at({x, y, z}));
                const Vec3 p{x, y, z};
                EXPECT_EQ(max(p, limits.low), p);
                EXPECT_EQ(min(p, limits.high), p);
            }
    EXPECT_EQ(grid.tile_at({11, 5.5, 11}), grid.tile_count() - 1);
}

TEST(TileGrid, names_the_tiles_that_something_reaches_into) {
    const TileGrid grid = shifted();
    std::vector<std::uint32_t> tiles;
    grid.for_tiles_at({{2.5, 2.5, 3.5}, {3.5, 3.5, 8.9}}, [&](std::uint32_t tile) { tiles.push_back(tile); });
    EXPECT_EQ(tiles, (std::vector<std::uint32_t>{0, 1}));
}

TEST(TileGrid, is_cut_by_its_extent) {
    TileGrid grid = shifted();
    grid.extent.high.z = 10;
    EXPECT_EQ(grid.limits(grid.tile_count() - 1).high.z, 10);
    EXPECT_EQ(grid.limits(0).high.z, 9);
}

TEST(TileGrid, without_bounds_its_outermost_tiles_have_no_end) {
    TileGrid grid = shifted();
    grid.is_bounded = false;
    EXPECT_EQ(grid.limits(0).low, (Vec3{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}));
    EXPECT_EQ(grid.limits(0).high, (Vec3{3, 4, 9}));
    EXPECT_EQ(grid.limits(grid.tile_count() - 1).high, (Vec3{HUGE_VAL, HUGE_VAL, HUGE_VAL}));
    EXPECT_EQ(grid.tile_at({-99, -99, -99}), 0u);
}

}  // namespace
}  // namespace regionmesh
