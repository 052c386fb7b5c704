// Permissions, links, pipes, and what runs that were killed leave behind.
#include "formats/part_files.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include "formats/temporary_folder.h"
#include "regionmesh/error.h"
#include "regionmesh/output_file.h"

namespace regionmesh {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

class PartFilesTest : public TemporaryFolder {
protected:
    void write(const std::string& name, const OutputOptions& options = {}) const {
        OutputFile file(path(name), options);
        file.write("after");
        file.commit();
    }
    std::string refusal(const std::string& name, const OutputOptions& options = {}) const {
        try {
            write(name, options);
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::kOutput);
            return error.what();
        }
        return "nothing thrown";
    }
    mode_t mode_of(const std::string& name) const {
        struct stat status {};
        ::stat(path(name).c_str(), &status);
        return status.st_mode & 07777;
    }
    /// The id of a process that has ended.
    static pid_t dead_process() {
        const pid_t child = ::fork();
        if (child == 0) ::_exit(0);
        ::waitpid(child, nullptr, 0);
        return child;
    }
};

TEST_F(PartFilesTest, a_private_file_stays_private_also_while_it_is_written) {
    put_text(path("a.txt"), "before");
    ::chmod(path("a.txt").c_str(), 0600);
    const OutputFile open(path("a.txt"));
    for (const auto& entry : fs::directory_iterator(path(".")))
        EXPECT_EQ(mode_of(entry.path().filename().string()), 0600u) << entry.path();
    write("a.txt");
    EXPECT_EQ(mode_of("a.txt"), 0600u);
    EXPECT_EQ(text_of(path("a.txt")), "after");
}

TEST_F(PartFilesTest, a_new_file_has_the_usual_permissions) {
    write("a.txt");
    put_text(path("b.txt"), "by another");
    EXPECT_EQ(mode_of("a.txt"), mode_of("b.txt"));
}

TEST_F(PartFilesTest, a_read_only_file_is_replaced_only_by_force_and_stays_read_only) {
    put_text(path("a.txt"), "before");
    ::chmod(path("a.txt").c_str(), 0444);
    EXPECT_THAT(refusal("a.txt"), HasSubstr("a.txt: is read-only"));
    EXPECT_EQ(text_of(path("a.txt")), "before");
    EXPECT_THROW(require_writable(path("a.txt")), Error);
    write("a.txt", {.force = true});
    EXPECT_EQ(text_of(path("a.txt")), "after");
    EXPECT_EQ(mode_of("a.txt"), 0444u);
    EXPECT_EQ(file_count(), 1);
}

TEST_F(PartFilesTest, links_that_lead_nowhere_are_refused_and_kept) {
    fs::create_symlink("none.txt", path("dangling"));
    fs::create_symlink("loop", path("loop"));
    for (const std::string name : {"dangling", "loop"}) {
        EXPECT_THAT(refusal(name), HasSubstr("is a link that leads nowhere"));
        EXPECT_THROW(require_writable(path(name)), Error);
        EXPECT_TRUE(fs::is_symlink(path(name)));
    }
    EXPECT_EQ(file_count(), 2);
}

TEST_F(PartFilesTest, a_pipe_that_nobody_reads_is_refused_and_one_with_a_reader_is_written) {
    ASSERT_EQ(::mkfifo(path("pipe").c_str(), 0600), 0);
    EXPECT_THAT(refusal("pipe"), HasSubstr("is a pipe that nobody reads"));
    const int reader = ::open(path("pipe").c_str(), O_RDONLY | O_NONBLOCK);
    ASSERT_GE(reader, 0);
    write("pipe");
    char text[9] = {};
    EXPECT_EQ(::read(reader, text, sizeof text), 5);
    EXPECT_STREQ(text, "after");
    ::close(reader);
}

TEST_F(PartFilesTest, files_of_killed_runs_are_removed_and_those_of_living_ones_are_not) {
    const std::string dead = std::to_string(dead_process());
    put_text(path(".a.txt.part-" + dead), "half");
    put_text(path(".a.txt.part-" + dead + "-1"), "half");
    put_text(path(".b.txt.part-" + dead), "of another output");
    put_text(path(".a.txt.part-" + std::to_string(::getppid())), "of a living process");
    put_text(path(".a.txt.part-of-mine"), "no file of ours");
    require_writable(path("a.txt"));
    EXPECT_FALSE(fs::exists(path(".a.txt.part-" + dead)));
    EXPECT_FALSE(fs::exists(path(".a.txt.part-" + dead + "-1")));
    EXPECT_EQ(file_count(), 3);
}

TEST_F(PartFilesTest, files_of_killed_runs_for_each_region_are_removed) {
    const std::string dead = std::to_string(dead_process());
    put_text(path(".m-1.stl.part-" + dead), "half");
    put_text(path(".m-25.stl.part-" + dead), "half");
    put_text(path(".m.stl.part-" + dead), "of the test whether it can be written");
    put_text(path(".m-1.obj.part-" + dead), "of another output");
    require_writable(path("m.stl"), {}, true);
    EXPECT_EQ(file_count(), 1);
}

TEST_F(PartFilesTest, files_together_get_their_names_or_none_does) {
    put_text(path("a.txt"), "before");
    fs::create_directory(path("folder"));
    {
        OutputFiles files;
        files.add(path("a.txt")).write("after");
        files.add(path("new.txt")).write("after");
        files.add(path("folder/c.txt")).write("after");
        fs::remove_all(path("folder"));  // the third cannot be renamed
        EXPECT_THROW(files.commit(), Error);
    }
    EXPECT_EQ(text_of(path("a.txt")), "before");
    EXPECT_EQ(file_count(), 1);
}

TEST_F(PartFilesTest, files_together_appear_and_leave_nothing_beside_them) {
    put_text(path("a.txt"), "before");
    {
        OutputFiles files({.sync = false});
        files.add(path("a.txt")).write("after");
        files.add(path("b.txt")).write("after");
        files.commit();
    }
    EXPECT_EQ(text_of(path("a.txt")), "after");
    EXPECT_EQ(text_of(path("b.txt")), "after");
    EXPECT_EQ(file_count(), 2);
}

TEST_F(PartFilesTest, signals_remove_what_is_not_complete) {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT}) {
        const pid_t child = ::fork();
        if (child == 0) {
            ::signal(signal, SIG_DFL);  // nohup and shells ignore some in what runs in the background
            remove_outputs_on_signals();
            OutputFile file(path("a.txt"));
            file.write(std::string(1 << 20, 'x'));
            put_text(path("ready"), "");
            for (;;) ::pause();
        }
        while (!fs::exists(path("ready"))) ::usleep(1000);
        EXPECT_EQ(file_count(), 2);
        ::kill(child, signal);
        int status = 0;
        ::waitpid(child, &status, 0);
        EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == signal);
        fs::remove(path("ready"));
        EXPECT_EQ(file_count(), 0);
    }
}

}  // namespace
}  // namespace regionmesh
