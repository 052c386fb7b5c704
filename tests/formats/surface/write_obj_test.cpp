#include <gmock/gmock.h>

#include "formats/surface/written_meshes.h"

namespace regionmesh {
namespace {

using testing::HasSubstr;

TEST_F(WriterTest, obj_has_a_group_for_each_pair_of_labels) {
    const std::string text = written(nested(), nested_labels(), "m.obj", {.background = {2}, .names = {{7, "core"}}});
    EXPECT_EQ(count_of(text, "\ng "), 2u);
    EXPECT_THAT(text, HasSubstr("\ng interface_5_7\n"));
    EXPECT_THAT(text, HasSubstr("\ng interface_5_0\n"));
    EXPECT_THAT(text, HasSubstr("\n# region 7 core\n"));
    EXPECT_EQ(count_of(text, "\nv "), 18u);
    EXPECT_EQ(count_of(text, "\nf "), 24u);
}

TEST_F(WriterTest, obj_holds_doubles_to_the_last_bit_and_the_exterior_as_its_number) {
    Mesh mesh;
    test::add_octahedron(mesh, {1.0 / 3, 0, 0}, {1, 1, 1}, 0, exterior(0));
    const std::string text = written(mesh, labels_from({-4}), "m.obj");
    EXPECT_THAT(text, HasSubstr("v 1.3333333333333333 0 0\n"));
    EXPECT_THAT(text, HasSubstr("# exterior_label -5\n"));
    EXPECT_THAT(text, HasSubstr("\ng interface_-4_-5\n"));
}

}  // namespace
}  // namespace regionmesh
