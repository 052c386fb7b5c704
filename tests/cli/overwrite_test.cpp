// No file that a run writes is one that it reads, or one that it writes a second time.
#include <filesystem>

#include "cli/program.h"

namespace regionmesh {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

class Overwrite : public Program {
protected:
    void SetUp() override {
        Program::SetUp();
        put_ball("v.raw");
        ASSERT_EQ(run("reconstruct " + volume() + "-o " + file("m.vtp")).code, 0);
    }

    std::string file(const std::string& name) const { return path(name).string(); }
    std::string volume() const { return ball("v.raw"); }

    /// The run ends with exit code 2 and one line, and changes no file.
    void expect_no_change(const std::string& arguments, const std::string& said) const {
        SCOPED_TRACE(arguments);
        const std::string volume_before = text_of(path("v.raw")), model_before = text_of(path("m.vtp"));
        expect_refusal(arguments, 2, said);
        EXPECT_EQ(text_of(path("v.raw")), volume_before);
        EXPECT_EQ(text_of(path("m.vtp")), model_before);
    }
};

TEST_F(Overwrite, of_an_input_by_a_report_or_a_model_is_refused) {
    expect_no_change("reconstruct " + volume() + "-o " + out("s.vtp") + " --report " + file("v.raw"),
                     "--report " + file("v.raw") + ": is the same file as " + file("v.raw") + ", which this run reads");
    expect_no_change("reconstruct " + volume() + "-o " + out("s.vtp") + " --regions " + file("v.raw"), "--regions");
    expect_no_change("check " + file("m.vtp") + " --json " + file("m.vtp"), "--json");
    expect_no_change("convert " + file("m.vtp") + " " + file("m.vtp"), "which this run reads");
    expect_no_change("compare " + file("m.vtp") + " " + file("m.vtp") + " --distance " + file("m.vtp"), "--distance");
    expect_no_change("voxelise " + file("m.vtp") + " --like " + volume() + " -o " + file("v.raw"), "--like");
}

TEST_F(Overwrite, by_two_outputs_is_refused) {
    expect_no_change("reconstruct " + volume() + "-o " + out("s.vtp") + " --report " + out("s.vtp"),
                     "which this run writes, too");
    expect_no_change("reconstruct " + volume() + "-o " + out("s.msh") + " --report " + out("s.geo"), "s.geo");
    for (const std::string other : {"--report ", "--html "})
        expect_no_change("reconstruct " + volume() + "-o " + out("s.vtp") + " --regions " + out("s.html") + ' ' +
                             other + out("s.html"),
                         "which this run writes, too");
    expect_no_change("check " + file("m.vtp") + " --regions " + out("r.csv") + " --json " + out("r.csv"), "r.csv");
    fs::create_directory_symlink(path("out"), path("link"));
    expect_no_change("reconstruct " + volume() + "-o " + out("s.vtp") + " --report " + file("link/s.vtp"), "--report");
}

TEST_F(Overwrite, through_a_link_or_another_spelling_is_refused) {
    fs::create_symlink(path("v.raw"), path("soft.json"));
    fs::create_hard_link(path("v.raw"), path("hard.json"));
    for (const std::string name : {"soft.json", "hard.json", "out/../v.raw"})
        expect_no_change("reconstruct " + volume() + "-o " + out("s.vtp") + " --report " + file(name), "--report");
    EXPECT_TRUE(fs::is_symlink(path("soft.json")));
}

TEST_F(Overwrite, of_a_file_in_an_input_folder_is_refused) {
    fs::create_directory(path("parts"));
    ASSERT_EQ(run("convert " + file("m.vtp") + " " + file("parts/a.stl")).code, 0);
    const std::string before = text_of(path("parts/a.stl"));
    expect_no_change("convert " + file("parts") + " " + file("parts/a.stl"), "is a file in");
    EXPECT_EQ(text_of(path("parts/a.stl")), before);
}

TEST_F(Overwrite, by_a_file_of_one_region_is_refused) {
    fs::copy_file(path("m.vtp"), path("p.vtp"));
    for (const std::string name : {"p-1.stl", "p--1.stl", "p-left_lung2.stl"}) {
        ASSERT_EQ(run("convert " + file("m.vtp") + " " + file(name)).code, 0);
        const std::string before = text_of(path(name));
        expect_no_change("convert " + file(name) + " " + file("p.stl") + " --per-region", name);
        EXPECT_EQ(text_of(path(name)), before);
    }
    ASSERT_EQ(run("convert " + file("m.vtp") + " " + file("p-1.of.stl")).code, 0);
    EXPECT_EQ(run("convert " + file("p-1.of.stl") + " " + file("p.stl") + " --per-region").code, 0);
}

TEST_F(Overwrite, two_inputs_may_be_one_file_and_devices_are_no_files) {
    EXPECT_EQ(run("compare " + file("m.vtp") + " " + file("m.vtp") + " --json /dev/null").code, 0);
    EXPECT_EQ(run("check " + file("m.vtp") + " --json /dev/null").code, 0);
}

}  // namespace
}  // namespace regionmesh
