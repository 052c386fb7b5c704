// What reconstruct says: three lines at the end, more with --verbose, all of it in --log.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/program.h"

namespace regionmesh {
namespace {

using testing::HasSubstr;
using testing::MatchesRegex;
using testing::StartsWith;

class Messages : public Program {
protected:
    void SetUp() override {
        Program::SetUp();
        put_ball("volume.raw");
    }

    std::string command(const std::string& more = "") const {
        return "reconstruct " + ball("volume.raw") + "-o " + out("m.vtp") + " --reduce 10% " + more;
    }
};

TEST_F(Messages, of_reconstruct_end_with_what_was_made_what_was_proved_and_where_it_lies) {
    const Ran ran = run(command("--report " + out("r.json")));
    EXPECT_EQ(ran.code, 0) << ran.error;
    EXPECT_EQ(ran.error, "");
    EXPECT_EQ(std::ranges::count(ran.out, '\n'), 4) << ran.out;
    EXPECT_THAT(ran.out, StartsWith("labels are clean\nmade: 1 region, "));
    EXPECT_THAT(ran.out, HasSubstr(" % of the samples are background, label 0 (--no-background makes it a region)\n"));
    EXPECT_THAT(ran.out, HasSubstr("\nchecked: no violations; every one of 729 samples keeps its label\n"));
    EXPECT_THAT(ran.out, HasSubstr("\nwritten: " + out("m.vtp") + ", report " + out("r.json") + "; "));
}

TEST_F(Messages, are_more_when_verbose_and_end_alike) {
    const Ran ran = run(command("--verbose"));
    EXPECT_EQ(ran.code, 0) << ran.error;
    for (const char* said : {"smoothing: ", "topology: ", "edges tried: accepted ", "seconds: ", "check "})
        EXPECT_THAT(ran.out, HasSubstr(said));
    EXPECT_GT(std::ranges::count(ran.out, '\n'), 6);
    EXPECT_GT(ran.out.rfind("\nwritten: "), ran.out.rfind("\nchecked: "));
    EXPECT_GT(ran.out.rfind("\nchecked: "), ran.out.rfind("\nmade: "));
}

TEST_F(Messages, go_into_the_log_with_the_command_and_the_stages_quiet_or_not) {
    const Ran ran = run(command("--quiet --log " + out("run.log")));
    EXPECT_EQ(ran.code, 0) << ran.error;
    EXPECT_EQ(ran.out + ran.error, "");
    const std::string log = text_of(out("run.log"));
    EXPECT_THAT(log, MatchesRegex(" +[0-9.]+ s  regionmesh reconstruct .*"));
    std::size_t at = 0;
    for (const char* said : {"count: 0 %", "reconstruct: ", "decimate: ", "check: 9", "samples: 99 %",
                             "seconds: ", "made: 1 region, ", "checked: ", "written: "}) {
        const std::size_t found = log.find(said, at);
        EXPECT_NE(found, std::string::npos) << said << " is not in\n" << log;
        if (found != std::string::npos) at = found;
    }
    // At the same time as the check.
    const std::size_t written = log.find(" s  write\n");
    EXPECT_TRUE(log.find("decimate: ") < written && written < log.find("seconds: ")) << log;
}

TEST_F(Messages, of_an_error_are_in_the_log) {
    const Ran ran = run("reconstruct " + path("none.npy").string() + " -o " + out("m.vtp") + " --log " + out("l"));
    EXPECT_EQ(ran.code, 1);
    EXPECT_THAT(text_of(out("l")), HasSubstr("none.npy: "));
}

TEST_F(Messages, log_that_cannot_be_written_is_refused_before_the_work) {
    expect_refusal(command("--log " + path("no/run.log").string()), 1, "no/run.log: cannot be written: No such file");
    expect_refusal(command("--log " + path("volume.raw").string()), 2, "is the same file as");
    expect_refusal(command("--log " + out("m.vtp")), 2, "is the same file as");
}

TEST_F(Messages, log_that_is_read_only_is_refused_without_force) {
    put_text(path("run.log"), "old");
    std::filesystem::permissions(path("run.log"), std::filesystem::perms::owner_read);
    expect_refusal(command("--log " + path("run.log").string()), 1, "run.log: ");
    EXPECT_EQ(text_of(path("run.log")), "old");
    EXPECT_EQ(run(command("--force --log " + path("run.log").string())).code, 0);
    EXPECT_THAT(text_of(path("run.log")), HasSubstr("written: "));
}

TEST_F(Messages, of_decimate_and_smooth_go_into_the_log) {
    ASSERT_EQ(run(command()).code, 0);
    for (const char* work : {"decimate --reduce 10%", "smooth"}) {
        const std::string made = out("made.vtp"), log = out("of.log");
        const Ran ran = run(std::string(work) + ' ' + out("m.vtp") + " -o " + made + " --quiet --log " + log);
        EXPECT_EQ(ran.code, 0) << ran.error;
        EXPECT_EQ(ran.out, "");
        EXPECT_THAT(text_of(log), HasSubstr("lowest quality"));
    }
}

TEST_F(Messages, page_is_a_file_of_the_run_like_the_others) {
    expect_refusal(command("--html " + path("volume.raw").string()), 2, "is the same file as");
    expect_refusal(command("--html " + out("m.vtp")), 2, "is the same file as");
}

}  // namespace
}  // namespace regionmesh
