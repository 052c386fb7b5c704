// Every command of docs/how-to/my-data.md runs as it is written there, and no other row is in its table.
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "cli/program.h"

namespace regionmesh {
namespace {

namespace fs = std::filesystem;

class MyData : public Program {
protected:
    /// The files that the page names, from tests/data.
    void SetUp() override {
        fs::create_directory(path("root"));
        for (const char* name :
             {"masks", "layers.seg.nrrd", "one_layer.vti", "two_arrays.vti", "v06.zarr", "damask.vti", "voxels.vtu",
              "tetgen_ref.msh", "geol.csv", "loca.csv", "plain.vtp", "labels_4_17_255.npy"})
            link(std::string("reports/") + name, name);
        link("reports/float_labels.nii", "labels.nii");
        link("reports/masks/liver.nii.gz", "liver.nii.gz");
        link("reports/masks/spleen.nii.gz", "spleen.nii.gz");
        link("reports/labels.npy", "grey.npy");
        link("dicom/explicit.dcm", "seg.dcm");
        link("contours/organs.csv", "organs.csv");
        link("png/gray8", "sections");
        link("more/ascii.tesr", "grains.tesr");
        link("points/points.csv", "points.csv");
        link("chunked/one.h5", "labels.h5");
        const std::string labels = text_of(data("reports/labels.npy"));
        put_text(path("root/labels.raw"), labels.substr(labels.size() - 480));
        put_text(path("root/labels.mat"),
                 "MATLAB 7.3 MAT-file" + std::string(512 - 19, ' ') + text_of(data("chunked/one.h5")));
        std::string shares = labels.substr(labels.size() - 480);
        for (const char label : std::string(shares)) shares += static_cast<char>(1 - label % 2);
        std::string head = "{'descr': '|u1', 'fortran_order': False, 'shape': (2, 6, 8, 10), }";
        head.resize(117, ' ');
        head = std::string("\x93NUMPY\x01\0\x76\0", 10) + head + '\n';
        put_text(path("root/shares.npy"), head + shares);
    }
    void link(const std::string& from, const std::string& name) const {
        ASSERT_TRUE(fs::exists(data(from))) << from;
        fs::create_symlink(data(from), path("root/" + name));
    }
};

TEST_F(MyData, each_command_of_the_page_runs) {
    std::ifstream page(test::source_folder() + "/docs/how-to/my-data.md");
    std::size_t count = 0;
    for (std::string line; std::getline(page, line);) {
        const std::size_t begin = line.find("`regionmesh "), end = line.rfind('`');
        if (!line.starts_with("| ") || begin == std::string::npos) continue;
        const std::string command = line.substr(begin + 12, end - begin - 12);
        const Ran ran = run(command, "cd '" + path("root").string() + "' &&");
        EXPECT_EQ(ran.code, 0) << command << "\n" << ran.error;
        EXPECT_THAT(ran.out, testing::HasSubstr("no violations")) << command << "\n" << ran.error;
        ++count;
    }
    EXPECT_GE(count, 20u);
}

}  // namespace
}  // namespace regionmesh
