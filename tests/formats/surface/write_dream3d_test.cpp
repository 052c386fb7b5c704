#include <gmock/gmock.h>

#include <chrono>
#include <thread>

#include "formats/surface/surfaces.h"
#include "formats/surface/written_meshes.h"
#include "regionmesh/error.h"

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

TEST_F(WriterTest, dream3d_file_has_the_same_bytes_a_second_later) {
    write_mesh(grains().mesh, grains().labels, path("a.dream3d"));
    std::this_thread::sleep_for(std::chrono::milliseconds(1100));  // times in HDF5 are whole seconds
    write_mesh(grains().mesh, grains().labels, path("b.dream3d"));
    EXPECT_TRUE(text_of(path("a.dream3d")) == text_of(path("b.dream3d")));
}

TEST_F(WriterTest, dream3d_refuses_labels_that_it_cannot_hold) {
    for (const InputLabel label : {std::int64_t{1} << 31, std::int64_t{-2}}) {
        try {
            write_mesh(test::octahedron(), labels_from({label, 0}), path("m.dream3d"));
            ADD_FAILURE() << "nothing thrown";
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::kOutput);
            EXPECT_THAT(error.what(), HasSubstr("label " + std::to_string(label)));
        }
    }
    EXPECT_EQ(file_count(), 0);
}

}  // namespace
}  // namespace regionmesh
