#include <gmock/gmock.h>

#include <numeric>

#include "formats/array/read_volume.h"
#include "formats/temporary_folder.h"

namespace regionmesh {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using ReadRawTest = TemporaryFolder;

TEST_F(ReadRawTest, little_endian_samples_are_read_along_every_axis_and_under_any_name) {
    std::string bytes;
    for (int v = 0; v < 60; ++v) bytes += {static_cast<char>(v - 30), static_cast<char>(v < 30 ? -1 : 0)};
    for (const char* name : {"a.raw", "a.bin", "a.npy", "a"}) {
        put_text(path(name), bytes);
        for (const SweepChoice sweep : {SweepChoice::kAuto, SweepChoice::kX, SweepChoice::kY, SweepChoice::kZ}) {
            const Volume volume = read_volume({path(name)}, raw({{5, 4, 3}}, SampleType::kI16, sweep));
            EXPECT_EQ(volume.info.format, "raw");
            EXPECT_EQ(volume.labels, expected(SampleType::kI16));
        }
    }
}

TEST_F(ReadRawTest, raw_file_without_size_or_type_is_told_which_flags_to_give) {
    put_text(path("a.raw"), "12345678");
    EXPECT_THAT(refusal({path("a.raw")}), HasSubstr("give --size X,Y,Z and --type uint8"));
    EXPECT_THAT(refusal({path("a.raw")}, raw({{2, 2, 2}}, std::nullopt)),
                HasSubstr("give --size X,Y,Z and --type uint8"));
    EXPECT_THAT(refusal({path("a.raw")}, raw(std::nullopt, SampleType::kU8)),
                HasSubstr("give --size X,Y,Z and --type uint8"));
}

TEST_F(ReadRawTest, file_of_another_format_is_raw_only_with_size_and_type) {
    put_text(path("a.npy"), "12345678");
    EXPECT_THAT(refusal({path("a.npy")}, raw(std::nullopt, SampleType::kU8)), HasSubstr("leave them out"));
    EXPECT_EQ(read_volume({path("a.npy")}, raw({{2, 2, 2}}, SampleType::kU8)).info.format, "raw");
}

TEST_F(ReadRawTest, length_that_is_not_exactly_the_samples_is_refused_with_both_counts) {
    put_text(path("a.raw"), "1234567");
    EXPECT_THAT(refusal({path("a.raw")}, raw({{2, 2, 2}}, SampleType::kU8)),
                AllOf(HasSubstr("7 bytes"), HasSubstr("take 8")));
    put_text(path("a.raw"), "123456789");
    EXPECT_THAT(refusal({path("a.raw")}, raw({{2, 2, 2}}, SampleType::kU8)),
                AllOf(HasSubstr("9 bytes"), HasSubstr("take 8")));
    EXPECT_THAT(refusal({path("a.raw")}, raw({{2, 0, 2}}, SampleType::kU8)), HasSubstr("empty volume: 2 x 0 x 2"));
    EXPECT_THAT(refusal({path("a.raw")}, raw({{4294967295, 1, 1}}, SampleType::kU8)), HasSubstr("more than 2^31 - 1"));
}

// Big enough for several blocks of sections and chunks of the file: label = a hash of x, y, z.
TEST_F(ReadRawTest, all_sweeps_of_a_volume_of_many_blocks_see_the_same_labels) {
    const std::array<std::uint32_t, 3> size{150, 310, 170};
    std::string bytes;
    std::vector<InputLabel> labels;
    for (std::uint32_t v = 0; v < size[0] * size[1] * size[2]; ++v) {
        labels.push_back((v * 2654435761u) >> 24);
        bytes.push_back(static_cast<char>(labels.back()));
    }
    put_text(path("a.raw"), bytes);
    for (const SweepChoice sweep : {SweepChoice::kX, SweepChoice::kY, SweepChoice::kZ}) {
        const auto reader = open_sections({path("a.raw")}, raw(size, SampleType::kU8, sweep));
        EXPECT_TRUE(pull(*reader) == labels);
    }
}

// Rows of x too long to be read over: 70000 samples.
TEST_F(ReadRawTest, long_rows_are_read_across_too) {
    const std::array<std::uint32_t, 3> size{70000, 3, 2};
    std::string bytes(70000 * 6, '\0');
    std::iota(bytes.begin(), bytes.end(), 0);
    put_text(path("a.raw"), bytes);
    for (const SweepChoice sweep : {SweepChoice::kX, SweepChoice::kY, SweepChoice::kZ}) {
        const auto reader = open_sections({path("a.raw")}, raw(size, SampleType::kI8, sweep));
        const auto labels = pull(*reader);
        EXPECT_TRUE(std::equal(labels.begin(), labels.end(), bytes.begin()));
    }
}

}  // namespace
}  // namespace regionmesh
