#include "cells/mixed_cells.h"

#include <gtest/gtest.h>

#include <array>

#include "support/random.h"

namespace regionmesh {
namespace {

TEST(MixedCells, are_those_of_more_than_one_label) {
    test::Random random(3);
    for (std::uint32_t cells = 1; cells < 40; ++cells) {
        std::array<std::vector<Label>, 4> rows;
        for (auto& row : rows)
            for (std::uint32_t n = 0; n <= cells; ++n) row.push_back(random.below(12) == 0 ? 7 : 5);
        std::vector<std::uint32_t> expected, found;
        for (std::uint32_t i = 0; i < cells; ++i) {
            bool is_mixed = false;
            for (const auto& row : rows) is_mixed |= row[i] != rows[0][i] || row[i + 1] != rows[0][i];
            if (is_mixed) expected.push_back(i);
        }
        MixedCells mixed(cells);
        mixed.find(rows[0].data(), rows[1].data(), rows[2].data(), rows[3].data());
        mixed.for_each([&](std::uint32_t i) { found.push_back(i); });
        EXPECT_EQ(found, expected);
    }
}

TEST(MixedCells, forget_the_row_before) {
    const std::vector<Label> same(9, 1), other(9, 2);
    MixedCells mixed(8);
    int visits = 0;
    const auto count = [&](std::uint32_t) { ++visits; };
    mixed.find(same.data(), same.data(), other.data(), same.data());
    mixed.for_each(count);
    EXPECT_EQ(visits, 8);
    mixed.find(same.data(), same.data(), same.data(), same.data());
    mixed.for_each(count);
    EXPECT_EQ(visits, 8);
}

}  // namespace
}  // namespace regionmesh
