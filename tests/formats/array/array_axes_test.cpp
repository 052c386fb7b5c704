#include "formats/array/array_axes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace regionmesh::formats {
namespace {

using testing::ElementsAre;
using Names = std::vector<std::string>;

std::array<int, 3> axes_of(const std::vector<std::uint64_t>& shape, const Names& names) {
    ReadOptions options;
    options.layer = 0;
    return choose_axes("a.zarr", shape, names, options).axis;
}

TEST(ChooseAxes, axes_without_a_name_are_what_is_left) {
    EXPECT_THAT(axes_of({4, 5, 6}, {"z", "", ""}), ElementsAre(2, 1, 0));
    EXPECT_THAT(axes_of({4, 5, 6, 2}, {"x", "", "z", "c"}), ElementsAre(0, 1, 2));
    EXPECT_THAT(axes_of({4, 5, 3}, {"", "x", "c"}), ElementsAre(1, 0, -1));
}

TEST(ChooseAxes, other_names_stand_for_a_missing_x_or_y) {
    EXPECT_THAT(axes_of({4, 5, 6}, {"X", "lat", "Z"}), ElementsAre(0, 1, 2));
    EXPECT_THAT(axes_of({4, 5, 6}, {"lat", "lon", "z"}), ElementsAre(1, 0, 2));
    EXPECT_THAT(axes_of({4, 5, 2}, {"y", "lon", "c"}), ElementsAre(1, 0, -1));
    EXPECT_THAT(axes_of({2, 4, 5, 6}, {"time", "z", "y", "lon"}), ElementsAre(3, 2, 1));
}

TEST(ChooseAxes, without_names_of_space_they_are_z_y_x) {
    EXPECT_THAT(axes_of({4, 5, 6}, {}), ElementsAre(2, 1, 0));
    EXPECT_THAT(axes_of({4, 5, 6}, {"a", "b", "c"}), ElementsAre(2, 1, 0));
}

}  // namespace
}  // namespace regionmesh::formats
