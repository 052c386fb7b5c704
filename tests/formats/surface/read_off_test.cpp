#include <gmock/gmock.h>

#include "formats/temporary_folder.h"
#include "regionmesh/check.h"
#include "regionmesh/error.h"
#include "regionmesh/mesh_file.h"
#include "support/paths.h"

namespace regionmesh {
namespace {

using testing::HasSubstr;

class OffFiles : public TemporaryFolder {
protected:
    std::string failure_of(const std::string& text) {
        put_text(path("a.off"), text);
        try {
            read_mesh(path("a.off"));
        } catch (const Error& error) {
            return error.what();
        }
        return "nothing thrown";
    }
};

TEST_F(OffFiles, are_one_region_of_polygons) {
    const MeshFile file = read_mesh(test::data_folder() + "/off/cube.off");
    const CheckReport report = check(file.mesh);
    EXPECT_EQ(report.violation_count(), 0u);
    ASSERT_EQ(report.regions.size(), 1u);
    EXPECT_EQ(report.regions.front().volume, 8);
    EXPECT_EQ(file.mesh.face_count(), 12u);
}

TEST_F(OffFiles, that_are_damaged_are_refused_with_their_line) {
    EXPECT_THAT(failure_of(""), HasSubstr("ends before its first line"));
    EXPECT_THAT(failure_of("OFF BINARY\n"), HasSubstr("has no number of points"));
    EXPECT_THAT(failure_of("ply\n"), HasSubstr("begins with 'ply'"));
    EXPECT_THAT(failure_of("OFF\n99999999999 1 0\n"), HasSubstr("is too short for 99999999999 points"));
    EXPECT_THAT(failure_of("OFF 3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n"),
                HasSubstr("line 5: a face names point '3' of 3"));
    EXPECT_THAT(failure_of("OFF 3 1 0\n0 0 0\n1 0 0\n0 1 0\n2 0 1\n"), HasSubstr("fewer than three corners"));
    EXPECT_THAT(failure_of("OFF 3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"), HasSubstr("ends before its faces"));
}

}  // namespace
}  // namespace regionmesh
