#include "regionmesh/label_table.h"

#include <gtest/gtest.h>

#include <initializer_list>
#include <limits>
#include <vector>

namespace regionmesh {
namespace {

constexpr InputLabel kLowest = std::numeric_limits<InputLabel>::min();

InputLabel exterior_of(std::initializer_list<InputLabel> labels, bool is_unsigned = false) {
    LabelTable table(is_unsigned);
    for (const InputLabel label : labels) table.dense(label);
    return table.exterior_label();
}

TEST(LabelTable, numbers_labels_in_order_of_first_appearance) {
    LabelTable table;
    EXPECT_EQ(table.dense(9), 0u);
    EXPECT_EQ(table.dense(-4), 1u);
    EXPECT_EQ(table.dense(9), 0u);
    EXPECT_EQ(table.size(), 2u);
    EXPECT_EQ(table.input(1), -4);
}

TEST(LabelTable, numbers_a_row_as_its_labels_one_by_one) {
    LabelTable one_by_one, table;
    const std::vector<InputLabel> row{0, 0, 5, 5, 0, -3, 5, kLowest, kLowest};
    std::vector<Label> dense(row.size()), expected;
    for (InputLabel label : row) expected.push_back(one_by_one.dense(label));
    table.dense(row, dense);
    EXPECT_EQ(dense, expected);
    EXPECT_EQ(table.size(), one_by_one.size());
    table.dense({}, {});
    EXPECT_EQ(table.size(), one_by_one.size());
}

TEST(LabelTable, exterior_is_minus_one_without_negative_labels) {
    EXPECT_EQ(exterior_of({}), -1);
    EXPECT_EQ(exterior_of({0, 7}), -1);
    EXPECT_EQ(exterior_of({0, 7}, true), -1);
}

TEST(LabelTable, exterior_is_below_the_smallest_negative_label) {
    EXPECT_EQ(exterior_of({3, -1}), -2);
    EXPECT_EQ(exterior_of({-5, 0}), -6);
    EXPECT_EQ(exterior_of({kLowest + 1}), kLowest);
}

TEST(LabelTable, unsigned_labels_beyond_2_to_63_are_not_taken_for_the_exterior) {
    EXPECT_EQ(exterior_of({0, static_cast<InputLabel>(0xFFFFFFFFFFFFFFFFu)}, true), -2);
}

TEST(LabelTable, exterior_is_free_even_where_the_lowest_label_is_taken) {
    EXPECT_EQ(exterior_of({kLowest}), -1);
    EXPECT_EQ(exterior_of({kLowest, -1, -2}), -3);
    EXPECT_EQ(exterior_of({static_cast<InputLabel>(std::uint64_t{1} << 63), -1}, true), -2);
}

}  // namespace
}  // namespace regionmesh
