#include <gmock/gmock.h>

#include "formats/surface/written_meshes.h"

namespace regionmesh {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST_F(WriterTest, msh_has_a_surface_for_each_two_solid_parts_and_a_name_for_each_interface) {
    const std::string text = written(nested(), nested_labels(), "m.msh", {.background = {2}});
    EXPECT_THAT(text, HasSubstr("$PhysicalNames\n2\n2 1 \"interface_5_7\"\n2 2 \"interface_5_0\"\n"));
    EXPECT_THAT(text, HasSubstr("$Entities\n0 0 3 0\n1 -2 -2 -2 2 2 2 1 1 0\n"));
    EXPECT_THAT(text, HasSubstr("$Nodes\n3 18 1 18\n"));
    EXPECT_THAT(text, HasSubstr("$Elements\n3 24 1 24\n2 1 2 8\n"));
}

TEST_F(WriterTest, geo_makes_a_volume_of_each_part_with_its_cavities) {
    write_mesh(nested(), nested_labels(), path("m.msh"), {.background = {2}, .names = {{7, "core"}}});
    const std::string text = text_of(path("m.geo"));
    EXPECT_EQ(count_of(text, "Surface Loop("), 4u);
    EXPECT_THAT(text, HasSubstr("Merge \"m.msh\";\n"));
    EXPECT_THAT(text, HasSubstr("Surface Loop(1) = {2};\nSurface Loop(3) = {1};\nVolume(1) = {1, 3};\n"));
    EXPECT_THAT(text, HasSubstr("= {-1};\n")) << "region 7 sees the interface from behind";
    EXPECT_THAT(text, HasSubstr("Physical Volume(\"region_5\", 5) = {1, 3};\n"));
    EXPECT_THAT(text, HasSubstr("Physical Volume(\"core\", 7) = {2};\n"));
}

TEST_F(WriterTest, msh_names_the_sides_of_the_box) {
    const std::string text = written(grains().mesh, grains().labels, "m.msh");
    for (const char* side : {"XMIN", "XMAX", "YMIN", "YMAX", "ZMIN", "ZMAX"})
        EXPECT_THAT(text, HasSubstr('"' + std::string(side) + '"'));
    EXPECT_THAT(text, HasSubstr("_exterior\""));
    EXPECT_THAT(text, Not(HasSubstr("_-1\"")));
}

TEST_F(WriterTest, msh_stands_only_beside_its_geo) {
    std::filesystem::create_directory(path("m.geo"));
    EXPECT_ANY_THROW(write_mesh(nested(), nested_labels(), path("m.msh"), {.background = {2}}));
    EXPECT_FALSE(std::filesystem::exists(path("m.msh")));
    EXPECT_EQ(file_count(), 1);
}

}  // namespace
}  // namespace regionmesh
