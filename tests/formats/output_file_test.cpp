#include "regionmesh/output_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <memory>
#include <string>
#include <vector>

#include "formats/temporary_folder.h"
#include "regionmesh/error.h"

namespace regionmesh {
namespace {

using OutputFileTest = TemporaryFolder;

// What `act` throws, which must be an Error(kOutput) of one line.
template <class Act>
std::string failure_of(Act&& act) {
    try {
        act();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::kOutput);
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
        return error.what();
    }
    return "nothing thrown";
}

TEST_F(OutputFileTest, has_its_name_only_after_commit) {
    OutputFile file(path("a.txt"));
    file.write("abc");
    EXPECT_FALSE(std::filesystem::exists(path("a.txt")));
    file.commit();
    EXPECT_EQ(text_of(path("a.txt")), "abc");
    EXPECT_EQ(file_count(), 1);
}

TEST_F(OutputFileTest, uncommitted_leaves_what_was_there) {
    put_text(path("a.txt"), "before");
    { OutputFile(path("a.txt")).write("after"); }
    EXPECT_EQ(text_of(path("a.txt")), "before");
    EXPECT_EQ(file_count(), 1);
}

TEST_F(OutputFileTest, overwrites_in_the_middle_and_goes_on_at_the_end) {
    OutputFile file(path("a.txt"));
    file.write("abcdef");
    file.overwrite(1, "XY");
    file.write("gh");
    EXPECT_EQ(file.size(), 8u);
    file.commit();
    EXPECT_EQ(text_of(path("a.txt")), "aXYdefgh");
}

TEST_F(OutputFileTest, two_at_once_do_not_meet) {
    OutputFile one(path("a.txt")), other(path("a.txt"));
    one.write("one");
    other.write("other");
    other.commit();
    one.commit();
    EXPECT_EQ(text_of(path("a.txt")), "one");
    EXPECT_EQ(file_count(), 1);
}

TEST_F(OutputFileTest, what_is_complete_takes_no_more) {
    OutputFile file(path("a.txt"));
    file.write("one");
    file.commit();
    EXPECT_THAT(failure_of([&] { file.write("two"); }), testing::HasSubstr("is closed already"));
    EXPECT_THAT(failure_of([&] { file.overwrite(0, "two"); }), testing::HasSubstr("is closed already"));
    EXPECT_NO_THROW(file.commit());
    EXPECT_EQ(text_of(path("a.txt")), "one");
}

TEST_F(OutputFileTest, files_that_belong_together_have_names_of_their_own) {
    OutputFiles files;
    files.add(path("a.txt")).write("one");
    EXPECT_THAT(failure_of([&] { files.add(path("a.txt")); }), testing::HasSubstr("is one of these files already"));
    files.add(path("b.txt")).write("two");
    files.commit();
    EXPECT_EQ(text_of(path("a.txt")), "one");
    EXPECT_EQ(text_of(path("b.txt")), "two");
}

TEST_F(OutputFileTest, follows_a_link) {
    put_text(path("real.txt"), "before");
    std::filesystem::create_symlink("real.txt", path("link.txt"));
    OutputFile file(path("link.txt"));
    file.write("after");
    file.commit();
    EXPECT_TRUE(std::filesystem::is_symlink(path("link.txt")));
    EXPECT_EQ(text_of(path("real.txt")), "after");
}

TEST_F(OutputFileTest, takes_a_name_of_255_bytes) {
    OutputFile file(path(std::string(255, 'n')));
    file.commit();
    EXPECT_EQ(file_count(), 1);
}

TEST_F(OutputFileTest, many_long_names_that_begin_alike_are_written_at_a_time) {
    std::vector<std::unique_ptr<OutputFile>> files;
    for (int n = 0; n < 150; ++n)
        files.push_back(std::make_unique<OutputFile>(path(std::string(240, 'n') + std::to_string(n))));
    for (const auto& file : files) file->commit();
    EXPECT_EQ(file_count(), 150);
}

TEST_F(OutputFileTest, full_disk_is_an_output_error) {
    const std::string text = failure_of([] {
        OutputFile file("/dev/full");
        file.write(std::string(1 << 20, 'x'));
        file.commit();
    });
    EXPECT_EQ(text, "/dev/full: cannot be written: No space left on device");
    EXPECT_TRUE(std::filesystem::is_character_file("/dev/full"));
}

TEST_F(OutputFileTest, full_disk_found_on_closing_is_an_output_error) {
    EXPECT_THAT(failure_of([] {
                    OutputFile file("/dev/full");
                    file.write("x");
                    file.commit();
                }),
                testing::HasSubstr("No space left"));
}

TEST_F(OutputFileTest, failed_write_removes_the_temporary_file) {
    const auto before = std::signal(SIGXFSZ, SIG_IGN);
    rlimit old_limit;
    getrlimit(RLIMIT_FSIZE, &old_limit);
    const rlimit small{1 << 16, old_limit.rlim_max};
    setrlimit(RLIMIT_FSIZE, &small);
    const std::string text = failure_of([&] {
        OutputFile file(path("a.txt"));
        file.write(std::string(1 << 20, 'x'));
        file.commit();
    });
    setrlimit(RLIMIT_FSIZE, &old_limit);
    std::signal(SIGXFSZ, before);
    EXPECT_THAT(text, testing::HasSubstr("File too large"));
    EXPECT_EQ(file_count(), 0);
}

TEST_F(OutputFileTest, missing_folder_and_folder_as_target_are_output_errors) {
    EXPECT_THAT(failure_of([&] { OutputFile file(path("none/a.txt")); }),
                testing::HasSubstr("No such file or directory; make its folder first"));
    std::filesystem::create_directory(path("folder"));
    EXPECT_THAT(failure_of([&] { OutputFile file(path("folder")); }), testing::HasSubstr("Is a directory"));
}

}  // namespace
}  // namespace regionmesh
