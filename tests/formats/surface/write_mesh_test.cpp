// What all formats promise alike.
#include <gmock/gmock.h>

#include <fstream>

#include "formats/surface/surfaces.h"
#include "formats/surface/written_meshes.h"
#include "regionmesh/error.h"

namespace regionmesh {
namespace {

using testing::HasSubstr;

std::vector<std::string> all_extensions() {
    std::istringstream words(writable_extensions());
    return {std::istream_iterator<std::string>(words), {}};
}

class EveryFormat : public WriterTest, public testing::WithParamInterface<std::string> {
protected:
    std::string name() const { return "m" + GetParam(); }
};
INSTANTIATE_TEST_SUITE_P(, EveryFormat, testing::ValuesIn(all_extensions()),
                         [](const auto& tested) { return tested.param.substr(1); });

TEST_P(EveryFormat, empty_model_is_written) { EXPECT_FALSE(written(Mesh(), LabelTable(), name()).empty()); }

TEST_P(EveryFormat, same_model_gives_the_same_bytes) {
    const std::string first = written(grains().mesh, grains().labels, name());
    EXPECT_EQ(written(grains().mesh, grains().labels, name()), first);
}

TEST_P(EveryFormat, full_disk_is_an_output_error_and_leaves_nothing) {
    std::filesystem::create_symlink("/dev/full", path(name()));
    try {
        write_mesh(grains().mesh, grains().labels, path(name()));
        ADD_FAILURE() << "nothing thrown";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::kOutput);
        EXPECT_THAT(error.what(), HasSubstr(name()));
    }
    EXPECT_EQ(file_count(), 1);
}

TEST_P(EveryFormat, folder_that_is_not_there_is_refused_before_the_work) {
    EXPECT_THROW(require_writable_mesh(path("none") / name()), Error);
    require_writable_mesh(path(name()));
    EXPECT_EQ(file_count(), 0);
}

class ReadableFormat : public WriterTest, public testing::WithParamInterface<const char*> {};
INSTANTIATE_TEST_SUITE_P(, ReadableFormat, testing::Values(".vtp", ".vtu", ".ply", ".obj", ".stl"),
                         [](const auto& tested) { return std::string(tested.param + 1); });

TEST_P(ReadableFormat, grains_come_back_to_the_bit) {
    if (GetParam() == std::string(".stl")) GTEST_SKIP() << "single precision: StlTest has it as text";
    write_mesh(grains().mesh, grains().labels, path("whole.vtp"));
    write_mesh(grains().mesh, grains().labels, path(std::string("m") + GetParam()));
    EXPECT_EQ(faces_of(read_mesh(path(std::string("m") + GetParam()))), faces_of(read_mesh(path("whole.vtp"))));
}

TEST_P(ReadableFormat, names_come_back) {
    const LabelNames names{{5, "Gyrus, \"left\""},
                           {7,
                            "\xC3\xA4u\xC3\x9F"
                            "eres"}};
    const std::string file = std::string("m") + GetParam();
    write_mesh(nested(), nested_labels(), path(file), {.background = {2}, .names = names});
    if (GetParam() == std::string(".stl"))
        EXPECT_TRUE(read_mesh(path(file)).names.empty()) << "binary: labels alone";
    else
        EXPECT_EQ(read_mesh(path(file)).names, names);
}

TEST_P(ReadableFormat, names_become_one_line) {
    const std::string file = std::string("m") + GetParam();
    const LabelNames names{{5, "a\nelement vertex 99"}, {7, ""}};
    write_mesh(nested(), nested_labels(), path(file), {.background = {2}, .names = names});
    const MeshFile read = read_mesh(path(file));
    EXPECT_EQ(read.mesh.face_count(), nested().face_count());
    const LabelNames lines{{5, "a element vertex 99"}};
    const bool has_names = GetParam() != std::string(".stl");
    EXPECT_EQ(has_names ? read.names : lines, lines);
}

class RegionFiles : public WriterTest, public testing::WithParamInterface<const char*> {};
INSTANTIATE_TEST_SUITE_P(, RegionFiles, testing::Values(".ply", ".obj", ".stl"),
                         [](const auto& tested) { return std::string(tested.param + 1); });

TEST_P(RegionFiles, each_is_closed_and_looks_outward) {
    write_mesh(nested(), nested_labels(), path(std::string("m") + GetParam()), {.background = {2}, .per_region = true});
    EXPECT_EQ(file_count(), GetParam() == std::string(".obj") ? 3 : 2) << "models, and the materials of .obj";
    for (const auto& [label, volume] : {std::pair{"5", 4 / 3.0 * (64 - 8 + 1)}, std::pair{"7", 4 / 3.0 * 8}}) {
        const MeshFile file = read_mesh(path(std::string("m-") + label + GetParam()));
        test::expect_sound(check(file.mesh));
        ASSERT_EQ(file.labels.size(), 1u);
        EXPECT_NEAR(volume_of(file, file.labels.input(0)), volume, 1e-5);
    }
}

TEST_P(RegionFiles, folder_of_them_is_the_model_again) {
    const Reconstruction& made = grains();
    write_mesh(made.mesh, made.labels, path(std::string("m") + GetParam()), {.per_region = true});
    const MeshFile file = read_mesh(path(""));
    EXPECT_EQ(file.mesh.face_count(), made.mesh.face_count());
    EXPECT_EQ(file.mesh.vertex_count(), made.mesh.vertex_count());
    test::expect_sound(check(file.mesh));
}

TEST_F(WriterTest, options_that_a_format_cannot_hold_are_refused_before_anything_is_written) {
    const auto failure = [&](const std::string& name, const WriteOptions& options) -> std::string {
        try {
            require_writable_mesh(path(name), options);
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::kOutput);
            return error.what();
        }
        return "nothing thrown";
    };
    EXPECT_THAT(failure("m.msh", {.per_region = true}), HasSubstr("written as .ply .stl .obj"));
    for (const char* name : {"m.msh", "m.smesh", "m.poly"})
        EXPECT_THAT(failure(name, {.boundary_is_open = true}), HasSubstr("leave out --boundary open"));
    EXPECT_THAT(failure("m.stl", {.point_arrays = {{"Distance", {}}}}), HasSubstr("only .vtp and .vtu"));
    EXPECT_EQ(file_count(), 0);
}

TEST_F(WriterTest, open_region_is_refused_by_formats_for_volume_meshers) {
    Mesh mesh = test::octahedron();
    mesh.remove_face(FaceId{3});
    for (const char* name : {"m.msh", "m.smesh", "m.poly"}) {
        try {
            write_mesh(mesh, test::labels_from({3, 0}), path(name), {.background = {1}});
            ADD_FAILURE() << "nothing thrown";
        } catch (const Error& error) {
            EXPECT_THAT(error.what(), HasSubstr("region 3 is not closed"));
        }
    }
    EXPECT_EQ(file_count(), 0);
}

}  // namespace
}  // namespace regionmesh
