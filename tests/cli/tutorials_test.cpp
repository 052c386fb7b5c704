// The commands of the tutorials run as they are written there.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "cli/program.h"

namespace regionmesh {
namespace {

namespace fs = std::filesystem;

class Tutorial : public Program {
protected:
    /// A folder that looks like the root of the sources, in which files may be written.
    void SetUp() override {
        fs::create_directory(path("root"));
        for (const char* folder : {"examples", "tests"})
            fs::create_directory_symlink(fs::path(test::source_folder()) / folder, path("root") / folder);
    }

    static std::vector<std::string> commands_of(const std::string& page) {
        std::ifstream stream(test::source_folder() + "/docs/tutorials/" + page);
        std::vector<std::string> commands;
        bool is_code = false;
        for (std::string line; std::getline(stream, line);) {
            if (line.starts_with("```")) is_code = !is_code;
            if (is_code && line.starts_with("regionmesh ")) commands.push_back(line.substr(11));
        }
        return commands;
    }

    /// Runs all commands of a page in order; each has to succeed. Returns what they printed.
    std::string run_page(const std::string& page) const {
        std::string printed;
        const auto commands = commands_of(page);
        EXPECT_GE(commands.size(), 5u) << page;
        for (const std::string& command : commands) {
            const Ran ran = run(command, "cd '" + path("root").string() + "' &&");
            EXPECT_EQ(ran.code, 0) << command << "\n" << ran.error;
            EXPECT_EQ(ran.error, "") << command;
            printed += ran.out;
        }
        EXPECT_THAT(printed, testing::HasSubstr("no violations"));
        EXPECT_THAT(printed, testing::HasSubstr("keeps its label"));
        return printed;
    }
};

TEST_F(Tutorial, geology) {
    const std::string printed = run_page("geology.md");
    EXPECT_THAT(printed, testing::HasSubstr("4 from young to old: soil, sand, clay, chalk; 100.0 %"));
    EXPECT_THAT(text_of(path("root/units.csv")), testing::HasSubstr("3,clay,")) << "the table that the page reads";
}

TEST_F(Tutorial, geology_finds_the_volume_of_the_clay) {
    run_page("geology.md");
    std::ifstream table(path("root/units.csv"));
    for (std::string line; std::getline(table, line);)
        if (line.starts_with("3,clay,")) {
            const double volume = std::stod(line.substr(line.find(',', 7) + 1));
            EXPECT_NEAR(volume, 4.9e6, 0.25e6) << "that of the surfaces from which the holes were made";
            return;
        }
    ADD_FAILURE() << "no row of the clay";
}

TEST_F(Tutorial, materials) { run_page("materials.md"); }

TEST_F(Tutorial, medicine) {
    if (!fs::exists("/usr/share/mricron/templates/aal.nii.gz")) GTEST_SKIP() << "apt install mricron-data";
    run_page("medical.md");
    EXPECT_THAT(text_of(path("root/hippocampus.glb")), testing::HasSubstr("\"scale\":[0.001,0.001,0.001]"))
        << "millimetres, which the atlas does not say";
}

}  // namespace
}  // namespace regionmesh
