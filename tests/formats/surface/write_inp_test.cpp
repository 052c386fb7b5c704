#include <gmock/gmock.h>

#include "formats/surface/written_meshes.h"

namespace regionmesh {
namespace {

using testing::HasSubstr;

TEST_F(WriterTest, inp_has_sets_of_interfaces_and_surfaces_that_look_out_of_regions) {
    const std::string text =
        written(nested(), nested_labels(), "m.inp", {.background = {2}, .names = {{7, "7th one"}}});
    EXPECT_THAT(text, HasSubstr("*ELEMENT, TYPE=S3, ELSET=interface_5_7\n1, "));
    EXPECT_THAT(text, HasSubstr("*ELSET, ELSET=region_5\ninterface_5_7\ninterface_5_0\n"));
    EXPECT_THAT(text, HasSubstr("NAME=region_5_surface\ninterface_5_7, SPOS\ninterface_5_0, SPOS\n"));
    EXPECT_THAT(text, HasSubstr("NAME=region_7th_one_surface\ninterface_5_7, SNEG\n"));
}

TEST_F(WriterTest, inp_reals_have_twenty_letters_at_most) {
    Mesh mesh;
    test::add_octahedron(mesh, {-1.2345678901234567e-5, 1.0 / 3, -1.2345678901234567e-300}, {0.1, 0.1, 0.1});
    const auto rows = rows_of(written(mesh, test::labels_from({1, 0}), "m.inp", {.background = {1}}));
    int reals = 0;
    for (const auto& row : rows) {
        if (row.size() != 4 || row[0] == "*ELEMENT,") continue;
        for (std::size_t n = 1; n < 4; ++n, ++reals) EXPECT_LE(row[n].size() - row[n].ends_with(','), 20u) << row[n];
    }
    EXPECT_GE(reals, 18);
    EXPECT_THAT(written(mesh, test::labels_from({1, 0}), "m.inp", {.background = {1}}),
                HasSubstr("0.3333333333333333,"));
}

TEST_F(WriterTest, inp_lists_the_vertices_of_each_side_of_the_box) {
    const std::string text = written(grains().mesh, grains().labels, "m.inp");
    for (const char* side : {"XMIN", "XMAX", "YMIN", "YMAX", "ZMIN", "ZMAX"}) {
        const std::size_t at = text.find("*NSET, NSET=" + std::string(side));
        ASSERT_NE(at, std::string::npos);
        std::istringstream lines(text.substr(at));
        std::string line;
        std::getline(lines, line);
        std::size_t vertices = 0;
        while (std::getline(lines, line) && !line.starts_with('*')) {
            EXPECT_LT(std::ranges::count(line, ','), 16);
            vertices += static_cast<std::size_t>(std::ranges::count(line, ',')) + !line.ends_with(',');
        }
        const int number =
            static_cast<int>(std::string("XYZ").find(side[0])) * 2 + (std::string(side).ends_with("MAX"));
        std::size_t expected = 0;
        test::for_vertices(grains().mesh, [&](VertexId v) { expected += grains().mesh[v].sides >> number & 1; });
        EXPECT_EQ(vertices, expected);
    }
}

}  // namespace
}  // namespace regionmesh
