// Standard streams that are full or closed: an exit code of 1, never an abort.
#include "cli/program.h"

namespace regionmesh {
namespace {

using testing::HasSubstr;

class Streams : public Program {
protected:
    void SetUp() override {
        Program::SetUp();
        put_ball("v.raw");
    }

    std::string volume() const { return ball("v.raw"); }

    /// Runs the program with its streams as `streams` says, after what `before` sets. A signal gives 128 and its
    /// number.
    int code_of(const std::string& arguments, const std::string& streams, const std::string& before = "") const {
        const std::string command = before + "'" + test::program() + "' " + arguments + " " + streams;
        put_text(path("command"), command);
        const int status = std::system(("bash '" + path("command").string() + "' 2>/dev/null").c_str());
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }
};

TEST_F(Streams, full_standard_error_does_not_abort) {
    EXPECT_EQ(code_of("info " + path("none.npy").string(), "2>/dev/full"), 1);
    EXPECT_EQ(code_of("info --none", "2>/dev/full"), 2);
    EXPECT_EQ(code_of("nothing", "2>/dev/full"), 2);
    EXPECT_EQ(code_of("info " + path("none.npy").string(), "<&- >&- 2>&-"), 1);
}

TEST_F(Streams, results_that_cannot_be_written_are_an_error) {
    for (const std::string& streams :
         {">/dev/full 2>'" + path("said").string() + "'", ">&- 2>'" + path("said").string() + "'"}) {
        SCOPED_TRACE(streams);
        EXPECT_EQ(code_of("info " + volume(), streams), 1);
        EXPECT_THAT(text_of(path("said")), HasSubstr("standard output cannot be written"));
        EXPECT_EQ(code_of("--help", streams), 1);
        EXPECT_EQ(code_of("--version", streams), 1);
        EXPECT_EQ(code_of("reconstruct " + volume() + "-o " + out("m.vtp"), streams), 1);
        EXPECT_EQ(code_of("reconstruct " + volume() + "--quiet -o " + out("m.vtp"), streams), 0);
    }
}

TEST_F(Streams, a_pipe_that_nobody_reads_is_an_error_and_no_signal) {
    const std::string said = path("said").string();
    EXPECT_EQ(code_of("info " + volume(), "2>'" + said + "' | true; exit ${PIPESTATUS[0]}"), 1);
    EXPECT_THAT(text_of(said), HasSubstr("standard output cannot be written"));
}

TEST_F(Streams, findings_go_to_standard_output_or_to_another_program) {
    const std::string info = "info " + volume() + "--json ", model = out("m.vtp");
    ASSERT_EQ(code_of("reconstruct " + volume() + "--quiet -o " + model, ""), 0);
    const std::string check = "check " + model + " --quiet --json ";
    ASSERT_EQ(code_of(check + out("as_file.json"), ""), 0);
    const std::string wanted = text_of(path("out") / "as_file.json");
    ASSERT_FALSE(wanted.empty());
    EXPECT_EQ(code_of(check + "/dev/stdout", "| cat > " + out("piped.json") + "; exit ${PIPESTATUS[0]}"), 0);
    EXPECT_EQ(text_of(path("out") / "piped.json"), wanted);
    EXPECT_EQ(code_of(check + ">(cat > " + out("read.json") + ")", "; code=$?; wait $!; exit $code"), 0);
    EXPECT_EQ(text_of(path("out") / "read.json"), wanted);
    EXPECT_EQ(code_of(info + "-", "2>'" + path("said").string() + "'"), 2);
    EXPECT_THAT(text_of(path("said")), HasSubstr("--json -: not the name of a file; standard output is /dev/stdout"));
}

TEST_F(Streams, a_file_at_its_limit_of_size_is_an_error_and_leaves_nothing) {
    const std::string said = path("said").string(), before = "ulimit -f 4; ";
    EXPECT_EQ(
        code_of("reconstruct " + volume() + "--smooth off --quiet -o " + out("m.vtp"), "2>'" + said + "'", before), 1);
    EXPECT_THAT(text_of(said), HasSubstr("m.vtp: cannot be written: File too large"));
    EXPECT_TRUE(std::filesystem::is_empty(path("out")));
}

TEST_F(Streams, a_missed_target_is_said_on_standard_error_when_quiet) {
    const Ran ran = run("reconstruct " + volume() + "--target-faces 1 --quiet -o " + out("m.vtp"));
    EXPECT_EQ(ran.code, 0);
    EXPECT_EQ(ran.out, "");
    EXPECT_THAT(ran.error, HasSubstr("stopped before the target: every further collapse would change topology"));
    EXPECT_EQ(run("reconstruct " + volume() + "--target-faces 1 -o " + out("m.vtp")).error, "");
}

TEST_F(Streams, an_error_that_bounds_nothing_is_not_reported_as_the_reason) {
    const Ran ran = run("reconstruct " + volume() + "--max-error 1e9 -o " + out("m.vtp"));
    EXPECT_THAT(ran.out, HasSubstr("stopped: every further collapse would change topology"));
}

TEST_F(Streams, a_quality_that_no_face_has_is_refused) {
    expect_refusal("reconstruct " + volume() + "--min-quality 0.27 -o " + out("m.vtp"), 2, "0 to 0.26");
}

TEST_F(Streams, closed_streams_do_not_mix_with_files) {
    EXPECT_EQ(code_of("reconstruct " + volume() + "--quiet -o " + out("a.vtp"), "<&- >&- 2>&-"), 0);
    ASSERT_EQ(run("reconstruct " + volume() + "-o " + out("b.vtp")).code, 0);
    EXPECT_EQ(text_of(path("out/a.vtp")), text_of(path("out/b.vtp")));
}

}  // namespace
}  // namespace regionmesh
