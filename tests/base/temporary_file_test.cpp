#include "base/temporary_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <string>

#include "formats/temporary_folder.h"
#include "regionmesh/error.h"

namespace regionmesh {
namespace {

using testing::HasSubstr;

/// TMPDIR as a test wants it, and afterwards as it was.
class TemporaryFileTest : public TemporaryFolder {
protected:
    TemporaryFileTest() {
        const char* was = std::getenv("TMPDIR");
        had_ = was != nullptr;
        if (was) was_ = was;
    }
    ~TemporaryFileTest() override { had_ ? setenv("TMPDIR", was_.c_str(), 1) : unsetenv("TMPDIR"); }

private:
    bool had_;
    std::string was_;
};

TEST_F(TemporaryFileTest, what_was_appended_is_read_at_any_place) {
    TemporaryFile file;
    EXPECT_EQ(file.size(), 0u);
    const std::array<int, 3> first{1, 2, 3};
    const std::array<double, 2> second{0.5, -7};
    file.append_items(std::span<const int>(first));
    file.append_items(std::span<const double>(second));
    file.append({});
    EXPECT_EQ(file.size(), 3 * sizeof(int) + 2 * sizeof(double));
    std::vector<double> doubles;
    EXPECT_EQ(file.read_items(3 * sizeof(int), 2, doubles), file.size());
    EXPECT_THAT(doubles, testing::ElementsAre(0.5, -7));
    std::vector<int> ints;
    EXPECT_EQ(file.read_items(sizeof(int), 2, ints), 3 * sizeof(int));
    EXPECT_THAT(ints, testing::ElementsAre(2, 3));
    EXPECT_EQ(file.read_items(file.size(), 0, ints), file.size());
    EXPECT_TRUE(ints.empty());
}

TEST_F(TemporaryFileTest, file_has_no_name_in_the_folder_of_TMPDIR) {
    setenv("TMPDIR", path("").c_str(), 1);
    TemporaryFile file;
    file.append_items(std::span<const int>(std::array<int, 1>{7}));
    EXPECT_EQ(file_count(), 0) << "a name is left behind if the program is stopped";
}

TEST_F(TemporaryFileTest, file_that_was_moved_goes_on) {
    TemporaryFile before;
    before.append_items(std::span<const int>(std::array<int, 1>{7}));
    TemporaryFile file(std::move(before));
    file.append_items(std::span<const int>(std::array<int, 1>{8}));
    std::vector<int> items;
    file.read_items(0, 2, items);
    EXPECT_THAT(items, testing::ElementsAre(7, 8));
}

TEST_F(TemporaryFileTest, folder_that_is_not_there_is_named_in_one_line) {
    const std::string nowhere = path("none").string();
    setenv("TMPDIR", nowhere.c_str(), 1);
    try {
        TemporaryFile file;
        FAIL() << "a file in a folder that is not there";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::kOutput);
        EXPECT_THAT(error.what(), HasSubstr(nowhere));
        EXPECT_THAT(error.what(), HasSubstr("TMPDIR"));
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    }
}

TEST_F(TemporaryFileTest, reading_beyond_the_end_is_an_error) {
    TemporaryFile file;
    file.append_items(std::span<const int>(std::array<int, 1>{7}));
    std::vector<int> items;
    EXPECT_THROW(file.read_items(0, 2, items), Error);
}

}  // namespace
}  // namespace regionmesh
