#include <gmock/gmock.h>

#include "formats/array/read_volume.h"
#include "formats/temporary_folder.h"

namespace regionmesh {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pair;
using testing::StartsWith;

class ReadInrTest : public TemporaryFolder {
protected:
    std::filesystem::path changed(const std::string& from, const std::string& to) {
        std::string text = text_of(data("inr/placed_uint8.inr"));
        text.replace(text.find(from), from.size(), to);
        put_text(path("a.inr"), text);
        return path("a.inr");
    }
    VolumeInfo info_of(const std::filesystem::path& file) { return open_sections({file})->info(); }
};

TEST_F(ReadInrTest, every_type_comes_back_label_for_label) {
    for (const auto& file : files_in("inr")) expect_as_named(file, "inr");
}

TEST_F(ReadInrTest, raw_files_sweep_along_every_axis_and_gzipped_ones_along_z) {
    EXPECT_THAT(info_of(data("inr/uint16.inr")).can_sweep, ElementsAre(true, true, true));
    EXPECT_THAT(info_of(data("inr/big_uint16.inr.gz")).can_sweep, ElementsAre(false, false, true));
}

TEST_F(ReadInrTest, places_in_space_are_those_of_the_header) {
    expect_in_space(info_of(data("inr/placed_uint8.inr")), {10, -20, 30}, {0.5, 0, 0, 0, 0.75, 0, 0, 0, 2});
    expect_in_space(info_of(data("inr/big_int8.inr.gz")), {0, 0, 0}, {0.5, 0, 0, 0, 0.75, 0, 0, 0, 2});
}

TEST_F(ReadInrTest, header_ends_where_its_last_line_says) {
    EXPECT_EQ(read_volume({changed("\n\n\n\n", "\n")}).labels, expected(SampleType::kU8));
    EXPECT_EQ(read_volume({changed("\n\n\n\n", "\n" + std::string(500, '\n'))}).labels, expected(SampleType::kU8));
}

TEST_F(ReadInrTest, table_beside_the_file_names_labels) {
    put_text(path("a.txt"), "3 three\n");
    EXPECT_THAT(info_of(changed("10", "11")).names, ElementsAre(Pair(3, "three")));
}

TEST_F(ReadInrTest, bad_files_are_refused_and_say_why) {
    EXPECT_EQ(read_volume({data("inr/bad/float32.inr")}).labels, expected(SampleType::kU8));
    EXPECT_THAT(refusal({data("inr/bad/turned.inr")}), HasSubstr("RX is '0.5': turned volumes are not read"));
    EXPECT_THAT(refusal({data("inr/bad/scaled.inr")}), HasSubstr("SCALE is '2**-3'"));
    const std::tuple<std::string, std::string, std::string> cases[] = {
        {"XDIM=5", "XDIM=0", "empty volume"},
        {"XDIM=5", "XDIM=-5", "XDIM is '-5'"},
        {"XDIM=5", "XDIM=2147483648", "more than 2^31 - 1"},
        {"XDIM=5", "XDIM=6", "truncated"},
        {"XDIM=5", "DIM=6", "XDIM is ''"},
        {"VDIM=1", "VDIM=3", "VDIM is '3'"},
        {"VX=0.5", "VX=0", "a positive spacing is needed"},
        {"VX=0.5", "VX=nan", "VX is 'nan'"},
        {"VX=0.5", "VX=", "VX is ''"},
        {"TX=10", "TX=inf", "TX is 'inf'"},
        {"TX=10", "TX=nan", "TX is 'nan'"},
        {"CPU=pc", "CPU=vax", "CPU is 'vax'"},
        {"8 bits", "12 bits", "PIXSIZE is '12 bits'"},
        {"##}", "##)", "header without an end"},
        {"#INR", "#JNR", "not an INRIMAGE-4 file"},
    };
    for (const auto& [from, to, message] : cases) EXPECT_THAT(refusal({changed(from, to)}), HasSubstr(message)) << to;
}

TEST_F(ReadInrTest, file_cut_anywhere_is_refused) {
    for (const char* name : {"uint16.inr", "big_uint16.inr.gz"}) {
        const std::string whole = text_of(data(std::string("inr/") + name));
        for (std::size_t length = 0; length < whole.size(); ++length) {
            put_text(path(name), whole.substr(0, length));
            EXPECT_THAT(refusal({path(name)}), StartsWith(path(name).string())) << length;
        }
    }
}

}  // namespace
}  // namespace regionmesh
