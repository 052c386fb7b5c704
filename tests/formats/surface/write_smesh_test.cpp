#include <gmock/gmock.h>

#include "formats/surface/written_meshes.h"

namespace regionmesh {
namespace {

using testing::HasSubstr;
using Rows = std::vector<std::vector<std::string>>;

/// The four parts of a file, without comments; each begins with its count.
std::vector<Rows> parts_of(const Rows& rows) {
    std::vector<Rows> parts;
    std::size_t left = 0;
    for (const auto& row : rows) {
        if (row[0] == "#") continue;
        if (left == 0) {
            parts.emplace_back();
            left = std::stoul(row[0]);
            continue;
        }
        parts.back().push_back(row);
        --left;
    }
    return parts;
}

TEST_F(WriterTest, smesh_has_a_seed_for_each_part_of_each_region) {
    const auto parts = parts_of(rows_of(written(nested(), nested_labels(), "m.smesh", {.background = {2}})));
    ASSERT_EQ(parts.size(), 4u);
    EXPECT_EQ(parts[0].size(), 18u);
    EXPECT_EQ(parts[1].size(), 24u);
    EXPECT_EQ(parts[2].size(), 0u) << "the background is not enclosed";
    ASSERT_EQ(parts[3].size(), 3u);
    for (std::size_t n = 0; n < 3; ++n) {
        const auto& seed = parts[3][n];
        ASSERT_EQ(seed.size(), 6u);
        EXPECT_EQ(seed[4], n < 2 ? "5" : "7") << "the label is the attribute";
        EXPECT_EQ(seed[5], "-1") << "no bound of the volume";
    }
    const double radius =
        std::abs(std::stod(parts[3][2][1])) + std::abs(std::stod(parts[3][2][2])) + std::abs(std::stod(parts[3][2][3]));
    EXPECT_LT(radius, 2) << "the seed of region 7 lies in it";
}

TEST_F(WriterTest, smesh_has_a_hole_for_background_that_is_enclosed) {
    const auto parts = parts_of(rows_of(written(nested(), nested_labels(), "m.smesh", {.background = {2, 1}})));
    ASSERT_EQ(parts[2].size(), 1u);
    EXPECT_EQ(parts[3].size(), 2u);
    for (const auto& seed : parts[3]) EXPECT_EQ(seed[4], parts[3][0][4]);
}

TEST_F(WriterTest, smesh_table_says_what_numbers_mean) {
    const std::string text =
        written(nested(), nested_labels(), "m.smesh", {.background = {2}, .names = {{7, "the core"}}});
    EXPECT_THAT(text, HasSubstr("# region 5 5 region_5\n# region 7 7 the_core\n"));
    EXPECT_THAT(text, HasSubstr("# interface 1 5 7\n# interface 2 5 0\n"));
}

TEST_F(WriterTest, faces_that_are_nearly_flat_have_different_markers_and_flat_ones_the_same) {
    for (const double height : {0.0, 1e-4, 0.5}) {
        // A pyramid of height 1 whose base has a vertex in its middle, `height` below.
        const Mesh mesh = test::shape(
            {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -height}},
            {{{0, 1, 4}}, {{1, 2, 4}}, {{2, 3, 4}}, {{3, 0, 4}}, {{1, 0, 5}}, {{2, 1, 5}}, {{3, 2, 5}}, {{0, 3, 5}}});
        const auto faces =
            parts_of(rows_of(written(mesh, test::labels_from({1, 0}), "m.smesh", {.background = {1}})))[1];
        for (std::size_t n = 4; n < 8; ++n) {
            const bool is_marked_apart = faces[n].back() != faces[4 + (n + 1) % 4].back();
            EXPECT_EQ(is_marked_apart, height == 1e-4) << height;
        }
    }
}

TEST_F(WriterTest, poly_is_the_same_with_facets_of_one_polygon) {
    const std::string text = written(nested(), nested_labels(), "m.poly", {.background = {2}});
    EXPECT_THAT(text, HasSubstr("\n24 1\n1 0 2\n3 "));
    EXPECT_EQ(count_of(text, "\n1 0 "), 24u);
}

}  // namespace
}  // namespace regionmesh
