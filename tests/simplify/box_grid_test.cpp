#include "simplify/box_grid.h"

#include <gtest/gtest.h>

namespace regionmesh {
namespace {

BoxGrid shifted() {
    return {.origin = {1, 2, 3}, .spacing = {1, 0.5, 2}, .size = {10, 7, 4}, .cells = {4, 4, 4}, .shift = {2, 0, 1}};
}

TEST(BoxGrid, covers_the_volume) {
    const BoxGrid grid = shifted();
    EXPECT_EQ(grid.count(0), 3u);  // 2, 4, 4 cells
    EXPECT_EQ(grid.count(1), 2u);  // 4, 3
    EXPECT_EQ(grid.count(2), 2u);  // 3, 1
    double volume = 0;
    for (std::uint32_t box = 0; box < grid.box_count(); ++box) {
        const Vec3 extent = grid.limits(box).high - grid.limits(box).low;
        volume += extent.x * extent.y * extent.z;
    }
    EXPECT_EQ(volume, 10 * 3.5 * 8);
}

TEST(BoxGrid, finds_the_box_of_a_point) {
    const BoxGrid grid = shifted();
    for (double x = 1.25; x < 11; x += 0.5)
        for (double y = 2.25; y < 5.5; y += 0.5)
            for (double z = 3.25; z < 11; z += 0.5) {
                const Box limits = grid.limits(grid.box_at({x, y, z}));
                const Vec3 p{x, y, z};
                EXPECT_EQ(max(p, limits.low), p);
                EXPECT_EQ(min(p, limits.high), p);
            }
    EXPECT_EQ(grid.box_at({11, 5.5, 11}), grid.box_count() - 1);
}

TEST(BoxGrid, names_the_boxes_that_something_reaches_into) {
    const BoxGrid grid = shifted();
    std::vector<std::uint32_t> boxes;
    grid.for_boxes_at({{2.5, 2.5, 3.5}, {3.5, 3.5, 8.9}}, [&](std::uint32_t box) { boxes.push_back(box); });
    EXPECT_EQ(boxes, (std::vector<std::uint32_t>{0, 1}));
}

TEST(BoxGrid, is_cut_by_its_extent) {
    BoxGrid grid = shifted();
    grid.extent.high.z = 10;
    EXPECT_EQ(grid.limits(grid.box_count() - 1).high.z, 10);
    EXPECT_EQ(grid.limits(0).high.z, 9);
}

}  // namespace
}  // namespace regionmesh
