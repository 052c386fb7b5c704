// DICOM segmentations as the program reads them: models, names, warnings.
#include <algorithm>

#include "cli/program.h"

namespace regionmesh {
namespace {

using testing::HasSubstr;

class CliDicom : public Program {
protected:
    static std::string file(const std::string& name) { return "'" + data("dicom/" + name) + "' "; }
    void make(const std::string& input, const std::string& model) const {
        const Ran ran = run("reconstruct " + input + "--units mm -o " + out(model));
        EXPECT_EQ(ran.code, 0) << ran.error;
        EXPECT_EQ(ran.error, "");
    }
};

TEST_F(CliDicom, an_oblique_segmentation_and_the_same_labels_in_nrrd_are_the_same_model) {
    make(file("same.seg.nrrd"), "nrrd.vtp");
    for (const char* name : {"explicit.dcm", "map_16_rle.dcm"}) {
        make(file(name), "dicom.vtp");
        EXPECT_EQ(text_of(out("dicom.vtp")), text_of(out("nrrd.vtp"))) << name << ": faces, names, colours and space";
        std::filesystem::remove(out("dicom.vtp"));
    }
}

TEST_F(CliDicom, check_finds_every_sample_in_its_region) {
    make(file("explicit.dcm") + "--between off ", "m.vtp");
    const Ran ran = run("check " + out("m.vtp") + " --sections " + file("deflated.dcm"));
    EXPECT_EQ(ran.code, 0) << ran.error;
    EXPECT_THAT(ran.out, HasSubstr("every one of 90 samples keeps its label"));
}

TEST_F(CliDicom, an_overlap_is_one_warning) {
    for (const std::string& command : {std::string("info "), "reconstruct -o " + out("m.vtp") + " "}) {
        const Ran ran = run(command + file("other/overlap.dcm"));
        EXPECT_EQ(ran.code, 0) << ran.error;
        EXPECT_EQ(std::ranges::count(ran.error, '\n'), 1) << ran.error;
        EXPECT_THAT(ran.error, HasSubstr("overlap.dcm: 19 samples are in several segments"));
    }
    const Ran ran = run("check " + out("m.vtp") + " --sections " + file("other/overlap.dcm"));
    EXPECT_EQ(ran.code, 0) << ran.error;
    EXPECT_EQ(std::ranges::count(ran.error, '\n'), 1) << "the volume is opened twice";
}

TEST_F(CliDicom, a_folder_of_images_is_one_line) {
    std::filesystem::create_directory(path("series"));
    std::filesystem::copy_file(data("dicom/bad/image.dcm"), path("series/IM0001"));
    expect_refusal("reconstruct " + path("series").string() + " -o " + out("m.vtp"), 1, "segment the series of images");
}

TEST_F(CliDicom, a_helper_that_is_missing_is_one_line) {
    expect_refusal("info " + file("explicit.dcm"), 1, "none: is no program that can be run",
                   "REGIONMESH_DICOM_PROGRAM=none");
}

}  // namespace
}  // namespace regionmesh
