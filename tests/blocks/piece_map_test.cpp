#include "blocks/piece_map.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace regionmesh {
namespace {

TEST(PieceMap, finds_the_pieces_that_a_look_at_all_of_them_finds) {
    std::mt19937 random(11);
    const auto number = [&](double low, double high) { return std::uniform_real_distribution<>(low, high)(random); };
    for (const double overhang : {0.0, 0.5, 7.0}) {
        const BlockGrid grid({.size = {20, 14, 9}, .spacing = {1, 2, 0.5}, .origin = {-3, 0, 10}}, 4, 2);
        std::vector<Box> boxes(grid.count());
        for (std::uint32_t block = 0; block < boxes.size(); ++block) {
            if (random() % 5 == 0) continue;  // no faces
            const Box own = grid.limits(block);
            const Vec3 over{number(0, overhang), number(0, overhang), number(0, overhang)};
            boxes[block] = {own.low - over, own.high + number(-1, 1) * over};
        }
        const PieceMap map(grid, boxes);
        std::vector<Box> asked;
        for (std::uint32_t block = 0; block < grid.count(); ++block) asked.push_back(grid.reach(block));
        for (int n = 0; n < 200; ++n) {
            const Vec3 low{number(-6, 18), number(-3, 28), number(8, 15)};
            asked.push_back({low, low + Vec3{number(0, 5), number(0, 5), number(0, 2)}});
        }
        for (const Box& box : asked) {
            std::vector<std::uint32_t> expected, found;
            for (std::uint32_t block = 0; block < boxes.size(); ++block)
                if (!boxes[block].is_empty() && overlap(boxes[block], box)) expected.push_back(block);
            map.for_pieces_at(box, [&](std::uint32_t block) { found.push_back(block); });
            EXPECT_EQ(found, expected);
        }
    }
}

}  // namespace
}  // namespace regionmesh
