// The program and its helper programs run with few rights where the kernel can take them away.
#include "regionmesh/sandbox.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <iterator>
#include <thread>

#include "cli/program.h"
#include "support/sandbox_state.h"

namespace regionmesh {
namespace {

using testing::HasSubstr;

class SandboxedProgram : public Program {
protected:
    void SetUp() override {
        Program::SetUp();
        put_ball("v.raw");
        // A helper that writes a file, as one that a damaged input has taken over might.
        put_text(path("helper"), "#!/bin/sh\necho taken > '" + path("taken").string() + "'\nexit 1\n");
        std::filesystem::permissions(path("helper"), std::filesystem::perms::owner_all);
        put_text(path("v.h5"), std::string("\x89HDF\r\n\x1a\n", 8) + std::string(100, '\0'));
    }
    std::string volume() const { return ball("v.raw"); }
    std::string helper() const { return "REGIONMESH_HDF5_PROGRAM='" + path("helper").string() + "'"; }
};

TEST_F(SandboxedProgram, models_and_reports_are_written_inside_it) {
    SKIP_WITHOUT(files, "Landlock");
    const std::string files =
        "-o " + out("m.obj") + " --report " + out("r.json") + " --html " + path("p.html").string();
    const Ran ran = run("reconstruct --require-sandbox " + volume() + files);
    EXPECT_EQ(ran.code, 0) << ran.error;
    EXPECT_TRUE(std::filesystem::exists(path("p.html")));
    EXPECT_EQ(run("reconstruct --require-sandbox " + volume() + "-o " + out("d.obj") + " --report /dev/null").code, 0)
        << "a device is written itself";
    EXPECT_EQ(run("check --require-sandbox " + out("m.obj") + " --json " + out("m.obj") + ".json").code, 0);
}

TEST_F(SandboxedProgram, no_program_but_the_helpers_is_started) {
    SKIP_WITHOUT(files, "Landlock");
    const Ran ran = run("info " + path("v.h5").string(), helper());
    EXPECT_EQ(ran.code, 1);
    EXPECT_THAT(ran.error, HasSubstr("cannot be started")) << "a script needs a shell";
    EXPECT_FALSE(std::filesystem::exists(path("taken")));
    EXPECT_EQ(run("info --no-sandbox " + path("v.h5").string(), helper()).code, 1);
    EXPECT_TRUE(std::filesystem::exists(path("taken"))) << "this is what the sandbox prevents";
}

TEST_F(SandboxedProgram, requiring_and_refusing_it_do_not_go_together) {
    expect_refusal("info --no-sandbox --require-sandbox " + volume(), 2, "--require-sandbox");
    EXPECT_EQ(run("info --no-sandbox " + volume()).code, 0);
}

/// The status of a program that waits for input, as soon as it filters its system calls; or its last status.
std::string status_of(const std::string& program, const std::vector<std::string>& arguments) {
    int input[2];
    if (::pipe2(input, O_CLOEXEC) != 0) return "";
    const pid_t child = ::fork();
    if (child == 0) {
        std::vector<char*> words{const_cast<char*>(program.c_str())};
        for (const std::string& argument : arguments) words.push_back(const_cast<char*>(argument.c_str()));
        words.push_back(nullptr);
        ::dup2(input[0], STDIN_FILENO);
        ::execv(program.c_str(), words.data());
        ::_exit(127);
    }
    std::string status;
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    while (status.find("Seccomp:\t2") == std::string::npos && std::chrono::steady_clock::now() < deadline) {
        std::ifstream file("/proc/" + std::to_string(child) + "/status");
        status.assign(std::istreambuf_iterator<char>(file), {});
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    ::close(input[1]);
    ::close(input[0]);
    ::waitpid(child, nullptr, 0);
    return status;
}

TEST_F(SandboxedProgram, helpers_filter_their_calls_before_they_read) {
    SKIP_WITHOUT(calls, "seccomp");
    for (const std::string& program : {test::hdf5_program(), test::dicom_program(), test::delaunay_program()}) {
        if (program.empty()) continue;  // not built
        SCOPED_TRACE(program);
        const bool has_argument = program != test::delaunay_program();
        const std::string status =
            status_of(program, has_argument ? std::vector{path("v.h5").string()} : std::vector<std::string>{});
        EXPECT_THAT(status, HasSubstr("Seccomp:\t2"));
        EXPECT_THAT(status, HasSubstr("NoNewPrivs:\t1"));
    }
}

}  // namespace
}  // namespace regionmesh
