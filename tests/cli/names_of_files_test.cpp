// Names of files that would command a terminal, or another program.
#include "cli/program.h"
#include "regionmesh/formats.h"

namespace regionmesh {
namespace {

using testing::HasSubstr;
using testing::Not;

class NamesOfFiles : public Program {
protected:
    void SetUp() override {
        Program::SetUp();
        put_ball("v.raw");
    }

    std::string volume() const { return ball("v.raw"); }
    void put_header(const std::string& data_file) const {
        std::filesystem::create_directory(path("in"));
        put_text(path("in/v.mhd"),
                 "NDims = 3\nDimSize = 9 9 9\nElementType = MET_UCHAR\nElementDataFile = " + data_file + "\n");
        put_text(path("in/v.nhdr"),
                 "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 9 9 9\nencoding: raw\ndata file: " + data_file + "\n");
    }
};

TEST_F(NamesOfFiles, that_a_script_would_run_are_refused_before_the_work) {
    for (const std::string name : {R"(m"; SystemCall "true"; ".msh)", R"(m\.msh)", "m\nq.msh"})
        expect_refusal("reconstruct " + volume() + "-o '" + out(name) + "'", 1,
                       "without quotes, backslashes and control");
    for (const std::string name : {"m\nusemtl x.obj", R"(m\.obj)"})
        expect_refusal("reconstruct " + volume() + "-o '" + out(name) + "'", 1, "without backslashes and control");
    for (const std::string name : {"m<!--.dream3d", "m:.dream3d"})
        expect_refusal("reconstruct " + volume() + "-o '" + out(name) + "'", 1,
                       "without quotes, colons, '<', '>', '&' and control");
}

TEST_F(NamesOfFiles, are_printed_without_their_control_characters) {
    const std::string name = "m\x1b]0;owned\x07\xc2\x9b.vtp";
    const Ran ran = run("reconstruct " + volume() + "-o '" + out(name) + "'");
    EXPECT_EQ(ran.code, 0) << ran.error;
    EXPECT_THAT(ran.out, HasSubstr("m\\x1b]0;owned\\x07\\xc2\\x9b.vtp; "));
    EXPECT_TRUE(std::filesystem::exists(out(name)));
    for (const std::string& text : {ran.out, run("info '" + out("none\x1b.npy") + "'").error,
                                    run("check '" + out(name) + "'").out, run("--x\x1b").error})
        EXPECT_THAT(text, Not(HasSubstr("\x1b")));
}

TEST_F(NamesOfFiles, outside_the_folder_of_a_header_are_refused_unless_asked_for) {
    for (const std::string& data : {std::string("../v.raw"), path("v.raw").string(), std::string("x/../../v.raw")}) {
        put_header(data);
        std::filesystem::create_directory(path("in/x"));
        for (const std::string header : {"in/v.mhd", "in/v.nhdr"}) {
            expect_refusal("info " + path(header).string(), 1, "outside its folder; give --external-files");
            EXPECT_EQ(run("info " + path(header).string() + " --external-files").code, 0);
        }
    }
}

TEST_F(NamesOfFiles, inside_the_folder_of_a_header_are_read_however_they_are_written) {
    put_header("");
    std::filesystem::create_directory(path("in/x"));
    std::filesystem::copy_file(path("v.raw"), path("in/x/v.raw"));
    for (const std::string& data :
         {std::string("x/v.raw"), std::string("./x/../x/v.raw"), path("in/x/v.raw").string()}) {
        put_header(data);
        for (const std::string header : {"in/v.mhd", "in/v.nhdr"})
            EXPECT_EQ(run("info " + path(header).string()).code, 0) << data;
    }
}

}  // namespace
}  // namespace regionmesh
