#include <gmock/gmock.h>

#include "formats/surface/written_meshes.h"

namespace regionmesh {
namespace {

using testing::HasSubstr;

TEST_F(WriterTest, obj_has_a_group_for_each_pair_of_labels) {
    const std::string text = written(nested(), nested_labels(), "m.obj", {.background = {2}, .names = {{7, "core"}}});
    EXPECT_EQ(count_of(text, "\ng "), 2u);
    EXPECT_THAT(text, HasSubstr("\no core\nusemtl core\ng interface_7_5\n"));
    EXPECT_THAT(text, HasSubstr("\ng interface_5_0\n"));
    EXPECT_THAT(text, HasSubstr("\n# region 7 core\n"));
    EXPECT_EQ(count_of(text, "\nv "), 18u);
    EXPECT_EQ(count_of(text, "\nf "), 24u);
}

/// Regions 0 to 3 in a row, without background: three interfaces, the exterior, and one in the others.
TEST_F(WriterTest, obj_has_an_object_for_each_region_even_where_its_label_is_never_the_smaller_one) {
    Mesh mesh;
    for (const Label inner : {1, 2, 3}) test::add_octahedron(mesh, {4.0 * inner, 0, 0}, {1, 1, 1}, inner, 0);
    test::add_octahedron(mesh, {8, 0, 0}, {20, 20, 20}, 0, exterior(0));
    const std::string text = written(mesh, test::labels_from({1, 2, 3, 4}), "m.obj");
    for (const char* region : {"region_1", "region_2", "region_3", "region_4"})
        EXPECT_EQ(count_of(text, std::string("\no ") + region + "\n"), 1u) << region;
    EXPECT_EQ(count_of(text, "\ng "), 4u);
}

TEST_F(WriterTest, normals_of_obj_point_out_of_the_object) {
    const std::string text = written(nested(), nested_labels(), "m.obj", {.background = {2}, .names = {{7, "core"}}});
    std::vector<Vec3> points;
    bool is_core = false;
    int faces = 0;
    for (const auto& row : rows_of(text)) {
        if (row.empty()) continue;
        if (row[0] == "o") is_core = row[1] == "core";
        if (row[0] == "v") points.push_back({std::stod(row[1]), std::stod(row[2]), std::stod(row[3])});
        if (row[0] != "f" || !is_core) continue;
        const Vec3 a = points[std::stoul(row[1]) - 1], b = points[std::stoul(row[2]) - 1],
                   c = points[std::stoul(row[3]) - 1];
        EXPECT_GT(dot(cross(b - a, c - a), a + b + c), 0) << "the core is round the origin";
        ++faces;
    }
    EXPECT_EQ(faces, 8);
}

TEST_F(WriterTest, obj_files_of_regions_share_one_file_of_materials) {
    write_mesh(nested(), nested_labels(), path("m.obj"),
               {.background = {2}, .names = {{7, "core"}}, .per_region = true});
    const std::string materials = text_of(path("m.mtl"));
    for (const std::string region : {"core", "region_5"}) {
        EXPECT_EQ(count_of(materials, "newmtl " + region + "\nKd "), 1u);
        const std::string text = text_of(path(region == "core" ? "m-core.obj" : "m-5.obj"));
        EXPECT_THAT(text, HasSubstr("mtllib m.mtl\n"));
        EXPECT_THAT(text, HasSubstr("usemtl " + region + "\n"));
    }
}

TEST_F(WriterTest, obj_holds_doubles_to_the_last_bit_and_the_exterior_as_its_number) {
    Mesh mesh;
    test::add_octahedron(mesh, {1.0 / 3, 0, 0}, {1, 1, 1}, 0, exterior(0));
    const std::string text = written(mesh, test::labels_from({-4}), "m.obj");
    EXPECT_THAT(text, HasSubstr("v 1.3333333333333333 0 0\n"));
    EXPECT_THAT(text, HasSubstr("# exterior_label -5\n"));
    EXPECT_THAT(text, HasSubstr("\ng interface_-4_-5\n"));
}

}  // namespace
}  // namespace regionmesh
