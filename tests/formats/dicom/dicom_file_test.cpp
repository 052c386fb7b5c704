#include "formats/dicom/dicom_file.h"

#include <gmock/gmock.h>

#include <cstdlib>

#include "formats/array/read_volume.h"
#include "formats/fake_program.h"
#include "regionmesh/error.h"

namespace regionmesh::formats {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

const std::filesystem::path kFile = data("dicom/explicit.dcm");

/// With a program of its own, if one is set.
class DicomFileTest : public FakePrograms {
protected:
    DicomFileTest() : before_(std::getenv("REGIONMESH_DICOM_PROGRAM")) {}
    ~DicomFileTest() override { use(before_); }

    static void use(const std::filesystem::path& program) { ::setenv("REGIONMESH_DICOM_PROGRAM", program.c_str(), 1); }
    /// Of opening the volume with a program that does what `lines` say.
    std::string problem_with(const std::string& lines) const {
        use(program(lines));
        return refusal({kFile});
    }

private:
    std::string before_;
};

TEST_F(DicomFileTest, frames_come_back_once_and_samples_as_often_as_asked) {
    DicomFile file(kFile);
    EXPECT_EQ(file.object().frames, 15u);
    const std::vector<DicomFrame> frames = file.take_frames();
    ASSERT_EQ(frames.size(), 15u);
    EXPECT_EQ(frames[0].pixel_spacing, (std::array{0.75, 0.5})) << "shared";
    EXPECT_TRUE(file.take_frames().empty());
    EXPECT_EQ(file.samples(3), file.samples(3));
    EXPECT_EQ(file.samples(3).size(), 2u) << "15 bits";
    EXPECT_THROW(file.samples(15), Error);
    EXPECT_EQ(file.samples(14).size(), 2u) << "a refusal does not end the program";
}

TEST_F(DicomFileTest, a_crash_and_an_early_end_are_the_fault_of_the_file) {
    for (const char* lines : {"kill -SEGV $$", "kill -PROF $$", "exit 0", "exit 3", "printf RMDCANS1"})
        EXPECT_THAT(problem_with(lines), StartsWith(kFile.string() + ": the DICOM library (DCMTK) fails on this file"))
            << lines;
}

TEST_F(DicomFileTest, another_program_is_named_with_its_last_words) {
    EXPECT_THAT(problem_with("echo no libdcmdata >&2; exit 127"),
                HasSubstr("failed with exit code 127 (no libdcmdata); is it another program?"));
    EXPECT_THAT(problem_with("head -c 16 >/dev/null; echo 0123456789abcdefg"),
                HasSubstr("did not answer as regionmesh-dicom"));
}

TEST_F(DicomFileTest, a_program_that_is_not_there_is_named) {
    use(path("none"));
    EXPECT_THAT(refusal({kFile}), HasSubstr("none: is no program that can be run; REGIONMESH_DICOM_PROGRAM gives it"));
}

}  // namespace
}  // namespace regionmesh::formats
