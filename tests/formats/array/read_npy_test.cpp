#include <gmock/gmock.h>

#include <algorithm>
#include <string>

#include "formats/array/read_volume.h"
#include "formats/temporary_folder.h"

namespace regionmesh {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;
using ReadNpyTest = TemporaryFolder;

/// A file with the header `text`.
std::string npy_with_header(const std::string& text, const std::string& samples = "12345678") {
    return std::string("\x93NUMPY\x01\x00", 8) + static_cast<char>(text.size()) + '\0' + text + samples;
}

TEST_F(ReadNpyTest, numpy_arrays_of_every_type_order_and_version_come_back_label_for_label) {
    for (const auto& file : files_in("npy")) {
        if (file.filename() == "one_section_uint8.npy") continue;
        for (const SweepChoice sweep : {SweepChoice::kAuto, SweepChoice::kX, SweepChoice::kY, SweepChoice::kZ}) {
            const Volume volume = read_volume({file}, swept(sweep));
            EXPECT_EQ(volume.info.format, "npy");
            EXPECT_EQ(volume.info.source, file.string());
            EXPECT_EQ(volume.info.type, type_in_name(file)) << file;
            EXPECT_EQ(volume.info.lattice.size, (std::array<std::uint32_t, 3>{5, 4, 3}));
            EXPECT_EQ(volume.labels, expected(type_in_name(file))) << file;
        }
    }
}

TEST_F(ReadNpyTest, auto_sweeps_the_axis_with_the_smallest_section) {
    EXPECT_EQ(open_sections({data("npy/uint8.npy")})->info().sweep.axes, kSweepX.axes);
}

TEST_F(ReadNpyTest, sections_across_the_order_of_the_file_are_read_in_blocks) {
    std::string samples(std::size_t{1200} * 5 * 1000, '\0');  // more than one block, each of several parts with gaps
    for (std::size_t n = 0; n < samples.size(); ++n) samples[n] = static_cast<char>(n * 2654435761u >> 24);
    put_text(path("wide.npy"),
             npy_with_header("{'descr': '|u1', 'fortran_order': False, 'shape': (1000, 5, 1200), }", samples));
    for (const SweepChoice sweep : kSweeps) {
        const Volume volume = read_volume({path("wide.npy")}, swept(sweep));
        EXPECT_TRUE(std::ranges::equal(volume.labels, samples, [](InputLabel label, char sample) {
            return label == static_cast<unsigned char>(sample);
        }));
    }
}

TEST_F(ReadNpyTest, array_with_two_axes_is_one_section) {
    const auto reader = open_sections({data("npy/one_section_uint8.npy")}, swept(SweepChoice::kZ));
    EXPECT_EQ(reader->info().lattice.size, (std::array<std::uint32_t, 3>{5, 4, 1}));
    EXPECT_EQ(pull(*reader)[7], 7);
}

TEST_F(ReadNpyTest, whole_reals_are_labels) {
    const Volume volume = read_volume({data("npy/bad/float32.npy")});
    EXPECT_EQ(volume.labels, expected(SampleType::kU8));
    EXPECT_EQ(volume.info.type, SampleType::kI64);
}

TEST_F(ReadNpyTest, samples_that_are_no_integers_are_refused_by_name) {
    EXPECT_THAT(refusal({data("npy/bad/complex64.npy")}), HasSubstr("samples are complex"));
    EXPECT_THAT(refusal({data("npy/bad/structured.npy")}), HasSubstr("structures"));
    EXPECT_THAT(refusal({data("npy/bad/text.npy")}), HasSubstr("not integers"));
}

TEST_F(ReadNpyTest, arrays_without_three_axes_or_samples_are_refused) {
    EXPECT_THAT(refusal({data("npy/bad/one_axis.npy")}), HasSubstr("1 dimensions"));
    EXPECT_THAT(refusal({data("npy/bad/four_axes.npy")}), HasSubstr("choose one with --layer 0 to"));
    EXPECT_THAT(refusal({data("npy/bad/empty.npy")}), HasSubstr("empty volume: 5 x 0 x 3"));
}

TEST_F(ReadNpyTest, truncated_samples_are_named_by_their_first_missing_section) {
    const std::string whole = text_of(data("npy/uint16.npy"));
    put_text(path("cut.npy"), whole.substr(0, whole.size() - 41));
    EXPECT_THAT(refusal({path("cut.npy")}),
                AllOf(HasSubstr("cut.npy: section 1: "), HasSubstr("79 bytes"), HasSubstr("120")));
}

TEST_F(ReadNpyTest, file_cut_short_after_it_was_opened_is_refused) {
    std::filesystem::copy_file(data("npy/uint16.npy"), path("cut.npy"));
    const auto reader = open_sections({path("cut.npy")});
    std::filesystem::resize_file(path("cut.npy"), 150);
    EXPECT_THROW(pull(*reader), Error);
}

TEST_F(ReadNpyTest, header_cut_anywhere_is_refused) {
    const std::string whole = text_of(data("npy/uint8.npy"));
    for (std::size_t length = 0; length < whole.size(); ++length) {
        put_text(path("cut.npy"), whole.substr(0, length));
        EXPECT_THAT(refusal({path("cut.npy")}), StartsWith(path("cut.npy").string())) << length;
    }
}

TEST_F(ReadNpyTest, header_of_a_mebibyte_is_read_in_a_moment) {
    std::string header = "{'descr': '|u1', 'fortran_order': False, 'shape': (1, 2, 4), }";
    header.resize(1'000'000, ' ');
    std::string length(4, '\0');
    for (std::size_t n = 0; n < 4; ++n) length[n] = static_cast<char>(header.size() >> (8 * n) & 255);
    put_text(path("long.npy"), std::string("\x93NUMPY\x02\x00", 8) + length + header + "12345678");
    EXPECT_EQ(read_volume({path("long.npy")}).labels.back(), '8');
}

TEST_F(ReadNpyTest, damaged_headers_are_refused) {
    for (const char* text :
         {"", "{", "{}", "()", "{'descr'", "{'descr': }", "{'descr': '<u1', 'fortran_order': 0, 'shape': (1,1,1)}",
          "{'descr': '<u1', 'fortran_order': False}", "{'descr': '', 'fortran_order': False, 'shape': (1,1,1)}",
          "{'descr': '<u1', 'fortran_order': False, 'shape': (1,1,1",
          "{'descr': '<u1', 'fortran_order': False, 'shape': (1 1)}",
          "{'descr': '<u1', 'fortran_order': False, 'shape': (-1,1,1)}", "{'other': 'x'}", "{'a\nb': 'x'}",
          "{'descr': '<u1' 'fortran_order': False}"}) {
        put_text(path("bad.npy"), npy_with_header(text));
        EXPECT_THAT(refusal({path("bad.npy")}), HasSubstr("bad.npy: the npy header is damaged")) << text;
    }
    put_text(path("bad.npy"), "GIF89a, not an array");
    EXPECT_THAT(refusal({path("bad.npy")}), HasSubstr("not an npy file"));
    put_text(path("bad.npy"), std::string("\x93NUMPY\x09\x00\x10\x00", 10) + "................");
    EXPECT_THAT(refusal({path("bad.npy")}), HasSubstr("npy version 9"));
}

TEST_F(ReadNpyTest, sizes_that_no_file_backs_are_refused_before_anything_is_allocated) {
    const auto refuse = [&](const std::string& shape) {
        put_text(path("big.npy"),
                 npy_with_header("{'descr': '<u8', 'fortran_order': False, 'shape': " + shape + ", }"));
        return refusal({path("big.npy")});
    };
    EXPECT_THAT(refuse("(2147483648, 1, 1)"), HasSubstr("more than 2^31 - 1"));
    EXPECT_THAT(refuse("(2147483647, 2147483647, 2147483647)"), HasSubstr("more than any file holds"));
    EXPECT_THAT(refuse("(18446744073709551616, 1, 1)"), HasSubstr("damaged"));
    EXPECT_THAT(refuse("(4294967297, 1, 1)"), HasSubstr("more than 2^31 - 1"));
    EXPECT_THAT(refuse("(100000, 100000, 100000)"), HasSubstr("truncated"));
}

}  // namespace
}  // namespace regionmesh
