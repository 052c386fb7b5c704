#include <gmock/gmock.h>

#include <limits>
#include <set>

#include "formats/surface/written_meshes.h"
#include "regionmesh/write_ascii_stl.h"

namespace regionmesh {
namespace {

using testing::HasSubstr;
using testing::Not;

class StlTest : public WriterTest {
protected:
    /// The bytes of the model as text.
    static std::string ascii_of(const Mesh& mesh, const LabelTable& labels, const std::filesystem::path& path,
                                const WriteOptions& options) {
        OutputFiles files;
        write_ascii_stl(mesh, labels, path, options, files);
        files.commit();
        return text_of(path);
    }
};

TEST_F(StlTest, ascii_stl_has_a_solid_for_each_region_and_each_interface_twice) {
    const std::string text =
        ascii_of(nested(), nested_labels(), path("m.stl"), {.background = {2}, .names = {{5, "liver"}}});
    EXPECT_THAT(text, HasSubstr("solid region_5 liver\n"));
    EXPECT_EQ(count_of(text, "endsolid region_"), 2u);
    EXPECT_EQ(count_of(text, "endfacet"), 8u * 4);
    EXPECT_THAT(text, Not(HasSubstr("region_0")));
}

TEST_F(StlTest, ascii_stl_normals_point_out_of_each_solid) {
    const auto rows = rows_of(ascii_of(nested(), nested_labels(), path("m.stl"), {.background = {2}}));
    double sum = 0;  // over the larger octahedron's faces and those of its cavity, as region 5 sees them
    for (std::size_t n = 0; n < rows.size() && rows[n][0] != "endsolid"; ++n) {
        if (rows[n][0] != "facet") continue;
        const Vec3 normal{std::stod(rows[n][2]), std::stod(rows[n][3]), std::stod(rows[n][4])};
        Vec3 corner{std::stod(rows[n + 2][1]), std::stod(rows[n + 2][2]), std::stod(rows[n + 2][3])};
        EXPECT_NEAR(length(normal), 1, 1e-12);
        if (corner.x > 6) corner.x -= 8;
        sum += dot(normal, corner);
    }
    EXPECT_NEAR(sum, (8 * 4 - 8 * 2 + 8 * 1) / std::sqrt(3), 1e-9);
}

TEST_F(StlTest, stl_of_the_smallest_label_and_minus_1_is_read_back) {
    constexpr InputLabel kSmallest = std::numeric_limits<InputLabel>::min();
    Mesh mesh;
    test::add_octahedron(mesh, {}, {1, 1, 1}, 0, exterior(0));
    test::add_octahedron(mesh, {4, 0, 0}, {1, 1, 1}, 1, exterior(0));
    write_mesh(mesh, test::labels_from({kSmallest, -1}), path("m.stl"));
    const MeshFile file = read_mesh(path("m.stl"));
    std::set<InputLabel> labels;
    for (std::uint32_t f = 0; f < file.mesh.face_end(); ++f)
        for (const Label label : file.mesh[FaceId{f}].labels)
            if (!is_exterior(label)) labels.insert(file.labels.input(label));
    EXPECT_THAT(labels, testing::ElementsAre(kSmallest, -1));
}

TEST_F(StlTest, binary_stl_has_a_record_for_each_face) {
    write_mesh(nested(), nested_labels(), path("m.stl"), {.background = {2}, .per_region = true});
    const std::string bytes = text_of(path("m-7.stl"));
    EXPECT_EQ(bytes.size(), 84u + 8 * 50);
    EXPECT_FALSE(bytes.starts_with("solid"));
    EXPECT_EQ(bytes[80], 8);
}

TEST_F(StlTest, stl_is_binary_with_labels_as_attributes_and_keeps_the_regions) {
    const std::string bytes = written(nested(), nested_labels(), "m.stl", {.background = {2}});
    EXPECT_EQ(bytes.size(), 84u + 8 * 4 * 50);
    EXPECT_FALSE(bytes.starts_with("solid"));
    const MeshFile file = read_mesh(path("m.stl"));
    EXPECT_EQ(file.mesh.face_count(), nested().face_count());
    std::set<InputLabel> labels;
    for (std::uint32_t f = 0; f < file.mesh.face_end(); ++f)
        for (const Label label : file.mesh[FaceId{f}].labels)
            if (!is_exterior(label)) labels.insert(file.labels.input(label));
    EXPECT_THAT(labels, testing::ElementsAre(5, 7));
}

TEST_F(StlTest, binary_stl_of_another_program_is_one_region) {
    std::string bytes = written(nested(), nested_labels(), "m.stl", {.background = {2}});
    bytes.replace(0, 6, "BINARY");
    put_text(path("other.stl"), bytes);
    EXPECT_EQ(read_mesh(path("other.stl")).labels.size(), 1u);
}

}  // namespace
}  // namespace regionmesh
