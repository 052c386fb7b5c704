// Runs the program in a folder of its own, as a user does.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <string>

#include "formats/temporary_folder.h"
#include "support/paths.h"
#include "support/volumes.h"

namespace regionmesh {

class Program : public TemporaryFolder {
public:
    struct Ran {
        int code = -1;
        std::string out, error;
    };

protected:
    void SetUp() override { std::filesystem::create_directory(path("out")); }

    /// A file of tests/data.
    static std::string data(const std::string& name) { return test::data_folder() + "/" + name; }

    /// `before` is put before the command: variables.
    Ran run(const std::string& arguments, const std::string& before = "") const {
        const std::string command = before + " '" + test::program() + "' " + arguments + " >'" +
                                    path("stdout").string() + "' 2>'" + path("stderr").string() + "' </dev/null";
        const int status = std::system(command.c_str());
        return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text_of(path("stdout")), text_of(path("stderr"))};
    }

    std::string out(const std::string& name) const { return path("out/" + name).string(); }
    std::ptrdiff_t files_left() const {
        return std::distance(std::filesystem::directory_iterator(path("out")), std::filesystem::directory_iterator());
    }

    /// Writes a volume: a ball of label 1 in 0.
    void put_ball(const std::string& name) const {
        const test::ArrayVolume ball = test::ball_volume({9, 9, 9}, 3);
        put_text(path(name), {ball.labels().begin(), ball.labels().end()});
    }
    /// Arguments that read it.
    std::string ball(const std::string& name) const { return path(name).string() + " --size 9,9,9 --type uint8 "; }

    void expect_refusal(const std::string& arguments, int code, const std::string& said,
                        const std::string& before = "") const {
        SCOPED_TRACE(arguments);
        const Ran ran = run(arguments, before);
        EXPECT_EQ(ran.code, code);
        EXPECT_EQ(std::ranges::count(ran.error, '\n'), 1) << ran.error;
        EXPECT_THAT(ran.error, testing::HasSubstr(said));
        EXPECT_EQ(ran.out, "");
        EXPECT_EQ(files_left(), 0) << "something was left behind";
    }
};

}  // namespace regionmesh
