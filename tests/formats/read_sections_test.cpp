#include <gmock/gmock.h>
#include <sys/stat.h>
#include <unistd.h>

#include <limits>

#include "formats/array/read_volume.h"
#include "formats/temporary_folder.h"

namespace regionmesh {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using ReadSectionsTest = TemporaryFolder;

TEST_F(ReadSectionsTest, nothing_to_read_is_refused) { EXPECT_THAT(refusal({}), HasSubstr("no input")); }

TEST_F(ReadSectionsTest, missing_files_of_every_format_are_refused) {
    for (const char* name : {"a.npy", "a.nii", "a.nii.gz", "a.tif", "a.png", "a.raw", "a.xyz", "a", "a.nrrd", "a.nhdr",
                             "a.mha", "a.mhd", "a.vti", "a.inr", "a.inr.gz", "a.mgz", "a.mgh"}) {
        EXPECT_THAT(refusal({path(name)}), HasSubstr(path(name).string() + ": no such file")) << name;
    }
}

TEST_F(ReadSectionsTest, unknown_formats_are_refused_with_a_list_of_those_known) {
    for (const char* name : {"a.xyz", "a", "a.npy.gz", "a.nrrd.gz"}) {
        put_text(path(name), "x");
        EXPECT_THAT(refusal({path(name)}),
                    AllOf(HasSubstr("unknown format"), HasSubstr(".npy .nii .nii.gz"), HasSubstr(volume_extensions())))
            << name;
    }
}

TEST_F(ReadSectionsTest, extension_may_be_upper_case) {
    fs::copy_file(data("npy/uint8.npy"), path("A.NPY"));
    fs::copy_file(data("nifti/sform_uint8.nii.gz"), path("A.NII.GZ"));
    EXPECT_EQ(open_sections({path("A.NPY")})->info().format, "npy");
    EXPECT_EQ(open_sections({path("A.NII.GZ")})->info().format, "nifti");
}

TEST_F(ReadSectionsTest, unreadable_file_and_directory_are_refused) {
    fs::copy_file(data("npy/uint8.npy"), path("locked.npy"));
    fs::create_directory(path("locked"));
    fs::permissions(path("locked.npy"), fs::perms::none);
    fs::permissions(path("locked"), fs::perms::none);
    const bool is_root = ::geteuid() == 0;  // who reads everything
    ASSERT_EQ(is_root ? ::seteuid(65534) : 0, 0);
    const std::string file = refusal({path("locked.npy")}), directory = refusal({path("locked")});
    ASSERT_EQ(is_root ? ::seteuid(0) : 0, 0);
    EXPECT_THAT(file, HasSubstr("locked.npy: permission denied"));
    EXPECT_THAT(directory, HasSubstr("locked: the directory cannot be read"));
}

TEST_F(ReadSectionsTest, pipe_is_refused_without_waiting_for_it) {
    ASSERT_EQ(::mkfifo(path("pipe.npy").c_str(), 0600), 0);
    EXPECT_THAT(refusal({path("pipe.npy")}), HasSubstr("not a regular file"));
}

TEST_F(ReadSectionsTest, given_spacing_takes_the_place_of_the_files) {
    const auto reader = open_sections({data("nifti/sform_uint8.nii")}, spaced(Vec3{1, 2, 5}));
    EXPECT_EQ(reader->info().lattice.spacing, (Vec3{1, 2, 5}));
    EXPECT_EQ(reader->info().lattice.origin, (Vec3{90, -126, -72}));
    for (const double bad :
         {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        EXPECT_THAT(refusal({data("npy/uint8.npy")}, spaced(Vec3{1, bad, 1})), HasSubstr("spacing along y")) << bad;
    }
}

TEST_F(ReadSectionsTest, raw_options_for_more_than_one_file_are_refused) {
    const ReadOptions options = raw({{5, 4, 3}}, SampleType::kU8);
    EXPECT_THAT(refusal({data("png/gray8")}, options), HasSubstr("this is a directory"));
    EXPECT_THAT(refusal({data("png/gray8/s1.png"), data("png/gray8/s2.png")}, options), HasSubstr("2 are given"));
}

TEST_F(ReadSectionsTest, equal_sections_are_swept_along_z_then_y) {
    const auto sweep = [&](std::array<std::uint32_t, 3> size) {
        put_text(path("a.raw"), std::string(size[0] * size[1] * size[2], 'x'));
        return open_sections({path("a.raw")}, raw(size, SampleType::kU8))->info().sweep.axes;
    };
    EXPECT_EQ(sweep({3, 3, 3}), kSweepZ.axes);
    EXPECT_EQ(sweep({3, 3, 2}), kSweepY.axes);
    EXPECT_EQ(sweep({4, 3, 3}), kSweepX.axes);
}

TEST_F(ReadSectionsTest, sample_types_have_one_word_each) {
    for (int i = 0; i <= static_cast<int>(SampleType::kU64); ++i) {
        const auto type = static_cast<SampleType>(i);
        EXPECT_EQ(parse_sample_type(to_string(type)), type);
    }
    EXPECT_EQ(to_string(SampleType::kU16), "uint16");
    EXPECT_EQ(parse_sample_type("float"), std::nullopt);
}

}  // namespace
}  // namespace regionmesh
