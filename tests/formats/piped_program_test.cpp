#include "formats/piped_program.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/wait.h>

#include <cerrno>
#include <csignal>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "formats/fake_program.h"
#include "regionmesh/error.h"

namespace regionmesh::formats {
namespace {

using testing::HasSubstr;

class PipedPrograms : public FakePrograms {
protected:
    ~PipedPrograms() override {
        EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1) << "a process is left behind";
        EXPECT_EQ(errno, ECHILD);
    }
};

bool send(PipedProgram& program, std::string_view text) { return program.send(std::as_bytes(std::span(text))); }

std::string receive(PipedProgram& program, std::size_t most) {
    std::string text(most, ' ');
    text.resize(program.receive(std::as_writable_bytes(std::span(text))));
    return text;
}

TEST_F(PipedPrograms, what_is_sent_comes_back_however_long) {
    PipedProgram sorter(program("exec sort"));
    std::string lines;
    for (int i = 0; i < 100000; ++i) lines += "a line\n";
    EXPECT_TRUE(send(sorter, lines));
    sorter.end_input();
    EXPECT_EQ(receive(sorter, 4), "a li");
    EXPECT_EQ(receive(sorter, 2 * lines.size()).size(), lines.size() - 4);
    EXPECT_EQ(sorter.end().exit_code, 0);
}

TEST_F(PipedPrograms, requests_are_answered_one_after_another) {
    PipedProgram echo(program("read -r a; echo $1$a; read -r b; echo $b$a"), {"x y"});
    EXPECT_TRUE(send(echo, "1\n"));
    EXPECT_EQ(receive(echo, 5), "x y1\n");
    EXPECT_TRUE(send(echo, "2\n"));
    EXPECT_EQ(receive(echo, 3), "21\n");
    EXPECT_EQ(echo.end().exit_code, 0);
}

TEST_F(PipedPrograms, one_that_writes_before_it_has_read_all_does_not_block) {
    PipedProgram hasty(program("exec cat"));
    const std::string much(5000000, 'x');
    EXPECT_FALSE(send(hasty, much));
}

TEST_F(PipedPrograms, one_that_ends_before_it_has_read_all_brings_no_signal) {
    PipedProgram lazy(program("exit 3"));
    const std::string much(5000000, 'x');
    EXPECT_FALSE(send(lazy, much));
    EXPECT_FALSE(send(lazy, "more"));
    EXPECT_EQ(receive(lazy, 10), "");
    const auto ending = lazy.end();
    EXPECT_EQ(ending.exit_code, 3);
    EXPECT_EQ(ending.signal, std::nullopt);
}

TEST_F(PipedPrograms, last_line_of_its_errors_is_kept_however_many_there_are) {
    PipedProgram loud(
        program("cat >/dev/null; head -c 1000000 /dev/zero | tr '\\0' '\\n' >&2\n"
                "echo first >&2; printf 'the\\033last \\n\\n' >&2; exit 1"));
    EXPECT_TRUE(send(loud, "a"));
    loud.end_input();
    EXPECT_EQ(receive(loud, 10), "");
    EXPECT_EQ(loud.end().last_words, "the last");
}

TEST_F(PipedPrograms, signal_that_ended_it_is_told) {
    PipedProgram killed(program("kill -9 $$"));
    EXPECT_EQ(receive(killed, 10), "");
    const auto ending = killed.end();
    EXPECT_EQ(ending.signal, SIGKILL);
    EXPECT_EQ(ending.exit_code, std::nullopt);
}

TEST_F(PipedPrograms, one_at_work_ends_with_the_object) {
    PipedProgram endless(program("exec sleep 1000"));
    EXPECT_TRUE(send(endless, "a"));
}

TEST_F(PipedPrograms, one_that_hangs_is_killed_and_one_that_computes_is_not) {
    PipedProgram hangs(program("exec sleep 1000"));
    hangs.set_patience(std::chrono::milliseconds(300));
    EXPECT_EQ(receive(hangs, 10), "");
    EXPECT_TRUE(hangs.end().was_idle);
    PipedProgram computes(program("n=0; while [ $n -lt 1000000 ]; do n=$((n+1)); done; echo done"));
    computes.set_patience(std::chrono::milliseconds(300));
    EXPECT_EQ(receive(computes, 10), "done\n");
    EXPECT_FALSE(computes.end().was_idle);
}

TEST_F(PipedPrograms, it_can_be_interrupted_by_a_broken_pipe_even_if_we_cannot) {
    const auto before = std::signal(SIGPIPE, SIG_IGN);
    PipedProgram writer(program("(yes; echo $? >&2) | head -n 1"));
    EXPECT_EQ(receive(writer, 10), "y\n");
    EXPECT_EQ(writer.end().last_words, std::to_string(128 + SIGPIPE));
    std::signal(SIGPIPE, before);
}

TEST_F(PipedPrograms, what_cannot_be_started_is_named) {
    const auto file = path("none");
    try {
        PipedProgram none(file);
        ADD_FAILURE() << "it was started";
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr(file.string() + ": cannot be started: "));
    }
}

TEST_F(PipedPrograms, no_other_program_inherits_its_files) {
    const auto open_files = [] {
        std::set<int> files;
        for (int file = 0; file < 100; ++file)
            if (::fcntl(file, F_GETFD) >= 0) files.insert(file);
        return files;
    };
    const auto before = open_files();
    {
        PipedProgram one(program("exec cat"));
        const auto now = open_files();
        EXPECT_EQ(now.size(), before.size() + 2);
        for (const int file : now) EXPECT_TRUE(before.contains(file) || (::fcntl(file, F_GETFD) & FD_CLOEXEC)) << file;
    }
    EXPECT_EQ(open_files(), before);
}

}  // namespace
}  // namespace regionmesh::formats
