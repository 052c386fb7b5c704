#include "regionmesh/sandbox.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <functional>
#include <string>
#include <thread>

#include "formats/temporary_folder.h"
#include "support/sandbox_state.h"

namespace regionmesh {
namespace {

class Sandbox : public TemporaryFolder {
protected:
    static constexpr int kDone = 0;

    void SetUp() override {
        std::filesystem::create_directory(path("in"));
        std::filesystem::create_directory(path("out"));
        put_text(path("in/file"), "text");
        put_text(path("out/old"), "text");
    }

    /// The errno that `act` leaves in a process with these rights; kDone where it succeeds, -1 where it ends otherwise.
    static int error_of(const SandboxRules& rules, const std::function<bool()>& act) {
        const pid_t child = ::fork();
        if (child == 0) {
            enter_sandbox(rules);
            errno = 0;
            ::_exit(act() ? kDone : errno);
        }
        int status = 0;
        ::waitpid(child, &status, 0);
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }

    std::function<bool()> opening(const std::string& name, int flags) const {
        return [file = path(name), flags] { return ::open(file.c_str(), flags | O_CLOEXEC, 0600) >= 0; };
    }
};

bool run(const char* program) {
    const pid_t child = ::fork();
    if (child == 0) {
        ::execl(program, program, nullptr);
        ::_exit(errno);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    errno = WEXITSTATUS(status);
    return WIFEXITED(status) && errno == 0;
}

TEST_F(Sandbox, files_are_made_and_replaced_in_the_folders_named_alone) {
    SKIP_WITHOUT(files, "Landlock");
    const SandboxRules rules{.writable = {path("out")}};
    EXPECT_EQ(error_of(rules, opening("out/new", O_WRONLY | O_CREAT)), kDone);
    EXPECT_EQ(error_of(rules, opening("out/old", O_WRONLY | O_TRUNC)), kDone);
    EXPECT_EQ(error_of(rules, [&] { return ::rename(path("out/new").c_str(), path("out/old").c_str()) == 0; }), kDone);
    EXPECT_EQ(error_of(rules, opening("in/new", O_WRONLY | O_CREAT)), EACCES);
    EXPECT_EQ(error_of(rules, opening("in/file", O_WRONLY)), EACCES);
    EXPECT_EQ(error_of(rules, [&] { return ::unlink(path("in/file").c_str()) == 0; }), EACCES);
    EXPECT_EQ(error_of(rules, opening("in/file", O_RDONLY)), kDone);
    EXPECT_EQ(text_of(path("in/file")), "text");
}

TEST_F(Sandbox, a_file_may_be_written_where_its_folder_may_not) {
    SKIP_WITHOUT(files, "Landlock");
    const SandboxRules rules{.writable = {path("out/old")}};
    EXPECT_EQ(error_of(rules, opening("out/old", O_WRONLY)), kDone);
    EXPECT_EQ(error_of(rules, opening("out/new", O_WRONLY | O_CREAT)), EACCES);
}

TEST_F(Sandbox, files_are_read_where_named_alone) {
    SKIP_WITHOUT(files, "Landlock");
    const SandboxRules rules{.reads_anything = false, .readable = {path("in/file")}};
    EXPECT_EQ(error_of(rules, opening("in/file", O_RDONLY)), kDone);
    EXPECT_EQ(error_of(rules, opening("out/old", O_RDONLY)), EACCES);
    EXPECT_EQ(error_of(rules, opening("in/file", O_RDWR)), EACCES);
}

TEST_F(Sandbox, no_sockets_are_made_in_any_thread) {
    SKIP_WITHOUT(calls, "seccomp");
    const auto make = [] { return ::socket(AF_INET, SOCK_STREAM, 0) >= 0; };
    EXPECT_EQ(error_of({}, make), EPERM);
    EXPECT_EQ(error_of({}, [] { return ::socket(AF_UNIX, SOCK_STREAM, 0) >= 0; }), EPERM);
    EXPECT_EQ(error_of({},
                       [&] {
                           int error = 0;
                           std::thread([&] { error = make() ? 0 : errno; }).join();
                           errno = error;
                           return error == 0;
                       }),
              EPERM);
    int pair[2];
    EXPECT_EQ(error_of({}, [&] { return ::socketpair(AF_UNIX, SOCK_STREAM, 0, pair) == 0; }), kDone)
        << "the helper programs are spoken to over one";
}

TEST_F(Sandbox, no_program_is_started_unless_named) {
    SKIP_WITHOUT(calls, "seccomp");
    EXPECT_EQ(error_of({}, [] { return run("/bin/true"); }), EPERM);
    SKIP_WITHOUT(files, "Landlock");
    const SandboxRules rules{.starts_programs = true, .runnable = {"/bin/true"}};
    EXPECT_EQ(error_of(rules, [] { return run("/bin/true"); }), kDone);
    EXPECT_EQ(error_of(rules, [] { return run("/bin/ls"); }), EACCES);
    EXPECT_EQ(error_of({.starts_programs = true}, [] { return run("/bin/true"); }), EACCES);
}

TEST_F(Sandbox, rights_are_not_given_back) {
    SKIP_WITHOUT(files, "Landlock");
    const auto write_in = [&] {
        enter_sandbox({.writable = {path("in")}});
        errno = 0;
        return opening("in/new", O_WRONLY | O_CREAT)();
    };
    EXPECT_EQ(error_of({.writable = {path("out")}}, write_in), EACCES);
}

}  // namespace
}  // namespace regionmesh
