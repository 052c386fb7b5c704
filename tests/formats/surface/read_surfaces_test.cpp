// Surfaces that other programs wrote (tests/data/make_surfaces.py): the box 1 x 1 x 2, 3 below 5.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "formats/surface/surfaces.h"
#include "regionmesh/check.h"
#include "support/paths.h"

namespace regionmesh {
namespace {

std::filesystem::path surface_file(const std::string& name) {
    return std::filesystem::path(test::data_folder()) / "surfaces" / name;
}

class LabelledSurfaces : public testing::TestWithParam<const char*> {
protected:
    void SetUp() override {
        const std::string extension = std::filesystem::path(GetParam()).extension().string();
        if (readable_extensions().find(extension) == std::string::npos) GTEST_SKIP() << "the build leaves it out";
    }
};
INSTANTIATE_TEST_SUITE_P(, LabelledSurfaces,
                         testing::Values("vtk_quads.vtp", "meshio.vtu", "meshio_text.vtu", "meshio_quads.vtu",
                                         "dream3d_6.dream3d", "dream3d_8.dream3d", "regions"),
                         [](const auto& tested) {
                             std::string name = tested.param;
                             std::ranges::replace(name, '.', '_');
                             return name;
                         });

TEST_P(LabelledSurfaces, two_boxes_come_back_sound_with_their_labels) {
    const MeshFile file = read_mesh(surface_file(GetParam()));
    EXPECT_EQ(file.mesh.face_count(), 22u);
    EXPECT_EQ(file.mesh.vertex_count(), 12u);
    EXPECT_DOUBLE_EQ(volume_of(file, 3), 1);
    EXPECT_DOUBLE_EQ(volume_of(file, 5), 1);
    const CheckReport report = check(file.mesh);
    EXPECT_EQ(report.violation_count(), 0u);
    EXPECT_EQ(report.region_pairs, 1u);
    EXPECT_EQ(faces_of(file).size(), 22u);
    for (std::uint32_t v = 0; v < 12; ++v) EXPECT_NE(file.mesh[VertexId{v}].sides, 0) << "the box is not seen";
}

TEST_P(LabelledSurfaces, quads_and_triangles_are_the_same_surface) {
    const auto outer = [](const MeshFile& file) {
        int count = 0;
        for (const FaceWords& face : faces_of(file)) count += face.second[1] == "exterior";
        return count;
    };
    EXPECT_EQ(outer(read_mesh(surface_file(GetParam()))), 20);
}

class PlainSurfaces : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(, PlainSurfaces,
                         testing::Values("vtk_text.stl", "vtk_binary.stl", "vtk.obj", "vtk_big_endian.ply",
                                         "vtk_text.ply", "meshio.ply"),
                         [](const auto& tested) {
                             std::string name = tested.param;
                             std::ranges::replace(name, '.', '_');
                             return name;
                         });

TEST_P(PlainSurfaces, surface_without_labels_is_one_region_that_looks_outward) {
    const MeshFile file = read_mesh(surface_file(GetParam()));
    EXPECT_EQ(file.mesh.face_count(), 12u);
    EXPECT_DOUBLE_EQ(volume_of(file, 1), 1);
    const CheckReport report = check(file.mesh);
    // Points that the other half of the box uses came along, but in STL.
    EXPECT_EQ(report.violation_count(), report.counts[static_cast<int>(ViolationKind::kUnusedVertex)]);
}

}  // namespace
}  // namespace regionmesh
