#include <gmock/gmock.h>

#include "formats/array/read_volume.h"
#include "formats/temporary_folder.h"

namespace regionmesh {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using Dream3dVolumeTest = TemporaryFolder;

TEST_F(Dream3dVolumeTest, regions_and_geometry_are_found_in_files_of_versions_7_and_8) {
    for (const char* name : {"version7.dream3d", "version8.dream3d", "flat.dream3d"}) {
        for (const SweepChoice sweep : kSweeps) {
            const Volume volume = read_volume({data("chunked/" + std::string(name))}, swept(sweep));
            EXPECT_EQ(volume.info.format, "dream3d");
            EXPECT_EQ(volume.info.type, SampleType::kI32);
            EXPECT_EQ(volume.labels, expected(SampleType::kI32)) << name;
            EXPECT_EQ(volume.info.lattice.spacing, (Vec3{0.5, 1, 2}));
        }
    }
}

TEST_F(Dream3dVolumeTest, first_sample_lies_in_the_middle_of_the_first_cell) {
    EXPECT_EQ(open_sections({data("chunked/version7.dream3d")})->info().lattice.origin, (Vec3{10.25, 20.5, 31}));
    EXPECT_EQ(open_sections({data("chunked/version8.dream3d")})->info().lattice.origin, (Vec3{10.25, 20.5, 31}));
    EXPECT_EQ(open_sections({data("chunked/version8.dream3d")}, spaced({2, 4, 6}))->info().lattice.origin,
              (Vec3{11, 22, 33}));
}

TEST_F(Dream3dVolumeTest, extension_may_be_that_of_hdf5) {
    std::filesystem::copy_file(data("chunked/version8.dream3d"), path("a.h5"));
    EXPECT_EQ(open_sections({path("a.h5")})->info().format, "dream3d");
}

TEST_F(Dream3dVolumeTest, another_array_of_cells_may_be_named) {
    const Volume volume = read_volume({inside("version8.dream3d", "/DataStructure/Image Geometry/Cell Data/Mask")});
    EXPECT_EQ(volume.labels, expected([](InputLabel v) { return v % 3 == 0; }));
    EXPECT_EQ(volume.info.lattice.spacing, (Vec3{0.5, 1, 2}));
}

TEST_F(Dream3dVolumeTest, several_volumes_are_listed_and_one_is_named_by_its_container) {
    EXPECT_THAT(refusal({data("chunked/two.dream3d")}),
                AllOf(HasSubstr("/DataContainers/First/CellData/FeatureIds"), HasSubstr("/Second/")));
    EXPECT_EQ(read_volume({inside("two.dream3d", "/DataContainers/Second")}).labels,
              expected([](InputLabel v) { return v + 70; }));
}

TEST_F(Dream3dVolumeTest, arrays_that_are_no_labels_of_cells_are_refused) {
    const std::string cells = "/DataContainers/Image/CellData/";
    EXPECT_THAT(refusal({inside("flat.dream3d", cells + "Wrong")}), HasSubstr("does not fit the cells"));
    EXPECT_THAT(refusal({inside("version7.dream3d", cells + "EulerAngles")}), HasSubstr("does not fit the cells"));
    EXPECT_THAT(refusal({inside("version7.dream3d", cells + "None")}), HasSubstr("holds no " + cells + "None"));
}

}  // namespace
}  // namespace regionmesh
