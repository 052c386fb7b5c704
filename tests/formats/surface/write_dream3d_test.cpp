#include <gmock/gmock.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

#include "formats/surface/surfaces.h"
#include "formats/surface/written_meshes.h"
#include "regionmesh/error.h"
#include "support/paths.h"

namespace regionmesh {
namespace {

using testing::HasSubstr;

TEST_F(WriterTest, dream3d_file_comes_back_in_single_precision) {
    write_mesh(grains().mesh, grains().labels, path("m.dream3d"));
    const MeshFile file = read_mesh(path("m.dream3d"));
    ASSERT_EQ(file.mesh.face_count(), grains().mesh.face_count());
    test::expect_sound(check(file.mesh));
    for (const RegionReport& region : grains().report.check.regions)
        EXPECT_NEAR(volume_of(file, grains().labels.input(region.label)), region.volume, 1e-4);
}

TEST_F(WriterTest, dream3d_stands_beside_an_xdmf_that_names_its_arrays) {
    const auto written = write_mesh(grains().mesh, grains().labels, path("m.dream3d"));
    ASSERT_EQ(written.size(), 2u);
    const std::string text = text_of(path("m.xdmf")), faces = std::to_string(grains().mesh.face_count());
    EXPECT_THAT(text, HasSubstr("Dimensions=\"" + faces +
                                " 3\">m.dream3d:/DataStructure/TriangleDataContainer/SharedTriList<"));
    EXPECT_THAT(text, HasSubstr("m.dream3d:/DataStructure/TriangleDataContainer/Face Data/FaceLabels<"));
    EXPECT_ANY_THROW(require_writable_mesh(path("a<b.dream3d")));
    EXPECT_ANY_THROW(require_writable_mesh(path("a:b.dream3d")));
    EXPECT_NO_THROW(require_writable_mesh(path("a model's.dream3d")));
}

TEST_F(WriterTest, dream3d_file_has_the_same_bytes_a_second_later) {
    write_mesh(grains().mesh, grains().labels, path("a.dream3d"));
    std::this_thread::sleep_for(std::chrono::milliseconds(1100));  // times in HDF5 are whole seconds
    write_mesh(grains().mesh, grains().labels, path("b.dream3d"));
    EXPECT_TRUE(text_of(path("a.dream3d")) == text_of(path("b.dream3d")));
}

TEST_F(WriterTest, dream3d_refuses_labels_that_it_cannot_hold) {
    for (const InputLabel label : {std::int64_t{1} << 31, std::int64_t{-2}}) {
        try {
            write_mesh(test::octahedron(), test::labels_from({label, 0}), path("m.dream3d"));
            ADD_FAILURE() << "nothing thrown";
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::kOutput);
            EXPECT_THAT(error.what(), HasSubstr("label " + std::to_string(label)));
        }
    }
    EXPECT_EQ(file_count(), 0);
}

/// Another program in place of regionmesh-hdf5, while it lives.
class Helper {
public:
    Helper(const std::filesystem::path& path, const std::string& script) : before_(test::hdf5_program()) {
        std::ofstream(path) << "#!/bin/sh\n" << script;
        std::filesystem::permissions(path, std::filesystem::perms::owner_all);
        ::setenv("REGIONMESH_HDF5_PROGRAM", path.c_str(), 1);
    }
    ~Helper() { ::setenv("REGIONMESH_HDF5_PROGRAM", before_.c_str(), 1); }
    Helper(const Helper&) = delete;
    Helper& operator=(const Helper&) = delete;

private:
    std::string before_;
};

TEST_F(WriterTest, dream3d_without_memory_is_an_error_of_one_line) {
    write_mesh(grains().mesh, grains().labels, path("whole.dream3d"));
    int failed = 0, written = 0;
    for (const int kibibytes : {10000, 20000, 25000, 30000, 35000, 40000, 45000, 50000, 1000000}) {
        const Helper helper(path("limited"), "ulimit -v " + std::to_string(kibibytes) + "\nexec '" +
                                                 test::hdf5_program() + "' \"$@\"\n");
        const std::filesystem::path made = path(std::to_string(kibibytes) + ".dream3d");
        try {
            write_mesh(grains().mesh, grains().labels, made);
            EXPECT_TRUE(text_of(made) == text_of(path("whole.dream3d"))) << kibibytes;
            ++written;
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::kOutput);
            EXPECT_THAT(error.what(), HasSubstr("the HDF5 library needs more memory")) << kibibytes;
            EXPECT_FALSE(std::filesystem::exists(made));
            ++failed;
        }
    }
    EXPECT_GT(failed, 0);
    EXPECT_GT(written, 0);
}

TEST_F(WriterTest, dream3d_of_a_helper_that_crashes_or_is_another_program_is_refused) {
    const auto said_with = [&](const std::string& script) -> std::string {
        const Helper helper(path("other"), script);
        try {
            write_mesh(grains().mesh, grains().labels, path("m.dream3d"));
        } catch (const Error& error) {
            return error.what();
        }
        return "nothing thrown";
    };
    EXPECT_THAT(said_with("cat > /dev/null; echo half; kill -SEGV $$\n"), HasSubstr("needs more memory"));
    EXPECT_THAT(said_with("cat > /dev/null; echo half; exit 3\n"), HasSubstr("needs more memory"));
    EXPECT_THAT(said_with("cat > /dev/null; printf '\\011\\0\\0\\0\\0\\0\\0\\0half'\n"), HasSubstr("needs more memory"))
        << "four bytes of nine, and exit code 0";
    EXPECT_THAT(said_with("echo 'cannot' >&2; exit 2\n"), HasSubstr("failed with exit code 2 (cannot)"));
    EXPECT_THAT(said_with("echo 'no library' >&2; exit 127\n"),
                HasSubstr("(no library): one of its libraries is missing"));
    EXPECT_FALSE(std::filesystem::exists(path("m.dream3d")));
}

}  // namespace
}  // namespace regionmesh
