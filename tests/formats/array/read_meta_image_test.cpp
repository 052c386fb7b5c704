#include <fmt/format.h>
#include <gmock/gmock.h>

#include "formats/array/read_volume.h"
#include "formats/temporary_folder.h"

namespace regionmesh {
namespace {

using testing::Each;
using testing::ElementsAre;
using testing::ElementsAreArray;
using testing::HasSubstr;
using testing::Pair;
using testing::StartsWith;

class ReadMetaImageTest : public TemporaryFolder {
protected:
    /// 5 x 4 x 3 bytes, with a header in which `from` stands as `to`.
    std::filesystem::path meta(const std::string& from = "", const std::string& to = "") {
        std::string text =
            "ObjectType = Image\nNDims = 3\nDimSize = 5 4 3\nElementType = MET_UCHAR\nElementSpacing = 1 1 1\n"
            "ElementDataFile = LOCAL\n";
        if (!from.empty()) text.replace(text.find(from), from.size(), to);
        for (int v = 0; v < 60; ++v) text += static_cast<char>(v);
        put_text(path("a.mha"), text);
        return path("a.mha");
    }
    VolumeInfo info_of(const std::filesystem::path& file) { return open_sections({file})->info(); }
};

TEST_F(ReadMetaImageTest, files_of_vtk_and_itk_come_back_label_for_label) {
    for (const auto& file : files_in("meta")) {
        const std::string name = file.filename();
        if (!name.ends_with("raw") && !name.starts_with("hand_one_section")) expect_as_named(file, "metaimage");
    }
}

TEST_F(ReadMetaImageTest, places_in_space_are_those_of_the_header) {
    expect_in_space(info_of(data("meta/vtk_uint8.mha")), {10, -20, 30}, {0.5, 0, 0, 0, 0.75, 0, 0, 0, 2});
    // What ITK made of the NRRDs: rows of TransformMatrix are directions of axes.
    expect_in_space(info_of(data("meta/itk_oblique_uint16.mha")), {10, -20, 30},
                    {0.3, -0.6, 0, 0.4, 0.45, 0, 0, 0, -2});
    expect_in_space(info_of(data("meta/itk_flipped_uint8.mhd")), {10, -20, 30}, {-0.5, 0, 0, 0, -0.75, 0, 0, 0, 2});
    expect_in_space(info_of(data("meta/hand_one_volume_uint8.mha")), {10, -20, 30}, {0.5, 0, 0, 0, 0.75, 0, 0, 0, 2});
    expect_in_space(info_of(data("meta/hand_int64.mha")), {0, 0, 0}, {1, 0, 0, 0, 1, 0, 0, 0, 1});
}

TEST_F(ReadMetaImageTest, two_axes_are_one_section) {
    const Volume volume = read_volume({data("meta/hand_one_section_uint8.mha")});
    EXPECT_EQ(volume.info.lattice.size, (std::array<std::uint32_t, 3>{5, 4, 1}));
    EXPECT_EQ(volume.labels[19], 19);
    expect_in_space(volume.info, {0, 0, 0}, {0, -1, 0, 1, 0, 0, 0, 0, 1});
}

TEST_F(ReadMetaImageTest, a_pattern_alone_stands_for_a_file_for_each_section_from_the_first_number_on) {
    for (int n = 1; n <= 4; ++n) put_text(path(fmt::format("s{:02}.raw", n)), std::string(20, static_cast<char>(n)));
    for (const auto& [numbers, first] : {std::pair("", 1), {" 1", 1}, {" 2", 2}, {" 2 4", 2}}) {
        EXPECT_THAT(read_volume({meta("LOCAL", std::string("s%02d.raw") + numbers)}).labels,
                    ElementsAreArray(expected([&, first = first](InputLabel v) { return first + v / 20; })))
            << numbers;
    }
    put_text(path("s%02d.raw"), std::string(60, 'a'));
    EXPECT_THAT(read_volume({meta("LOCAL", "s%02d.raw")}).labels, Each('a')) << "the name of a file that is there";
    EXPECT_THAT(refusal({meta("LOCAL", "")}), HasSubstr("has no ElementDataFile"));
}

TEST_F(ReadMetaImageTest, raw_files_sweep_along_every_axis_and_others_along_z) {
    EXPECT_THAT(info_of(data("meta/vtk_int16.mhd")).can_sweep, ElementsAre(true, true, true));
    for (const char* name : {"vtk_zlib_uint32.mhd", "hand_pattern_uint8.mhd", "hand_ascii_int16.mha"})
        EXPECT_THAT(info_of(data(std::string("meta/") + name)).can_sweep, ElementsAre(false, false, true));
}

TEST_F(ReadMetaImageTest, table_beside_the_file_names_labels) {
    put_text(path("a.csv"), "label,name\n3,three\n");
    EXPECT_THAT(info_of(meta()).names, ElementsAre(Pair(3, "three")));
}

TEST_F(ReadMetaImageTest, bad_files_are_refused_and_say_why) {
    EXPECT_EQ(read_volume({data("meta/bad/float32.mha")}).labels, expected(SampleType::kU8));
    EXPECT_THAT(refusal({data("meta/bad/channels.mha")}), HasSubstr("has 3 channels a sample"));
    EXPECT_THAT(refusal({data("meta/bad/two_volumes.mha")}), HasSubstr("holds 2 volumes (axis 4 of DimSize)"));
    const std::tuple<std::string, std::string, std::string> cases[] = {
        {"5 4 3", "5 4 0", "empty volume"},
        {"5 4 3", "5 4", "DimSize is '5 4'"},
        {"5 4 3", "5 4 -3", "DimSize is '5 4 -3'"},
        {"5 4 3", "5 4 4", "the file holds 60 bytes of samples where its header says 80"},
        {"5 4 3", "2000000000 2000000000 2000000000", "more than any file holds"},
        {"NDims = 3", "NDims = 11", "has 11 axes"},
        {"NDims = 3", "NDims = x", "NDims is 'x'"},
        {"1 1 1", "1 1 0", "no affine map"},
        {"1 1 1", "1 1 nan", "no affine map"},
        {"1 1 1", "1 1", "ElementSpacing is '1 1': 3 numbers are needed"},
        {"ObjectType = Image", "HeaderSize = -2", "HeaderSize is '-2'"},
        {"ObjectType = Image", "HeaderSize = 1000", "truncated"},
        {"ObjectType = Image", "CompressedData = True", "the compressed stream is damaged"},
        {"ObjectType = Image", "what is this", "line 'what is this' is no MetaImage header"},
        {"LOCAL", "gone.raw", "gone.raw: no such file"},
        {"LOCAL", "LIST\ngone.raw", "gone.raw: no such file"},
        {"LOCAL", "z%d.raw 1 2 0", "never comes to its last number"},
        {"ElementDataFile = LOCAL\n", "", "is no MetaImage header"},
    };
    for (const auto& [from, to, message] : cases) EXPECT_THAT(refusal({meta(from, to)}), HasSubstr(message)) << to;
    put_text(path("b.mha"), "NDims = 3\n");
    EXPECT_THAT(refusal({path("b.mha")}), HasSubstr("has no ElementDataFile"));
    put_text(path("b.mha"), "");
    EXPECT_THAT(refusal({path("b.mha")}), HasSubstr("has no ElementDataFile"));
}

TEST_F(ReadMetaImageTest, file_cut_anywhere_is_refused) {
    for (const char* name : {"itk_oblique_uint16.mha", "vtk_zlib_uint16.mha", "hand_ascii_int16.mha"}) {
        const std::string whole = text_of(data(std::string("meta/") + name));
        const bool is_text = std::string(name).find("ascii") != std::string::npos;  // a number may lose its last digit
        for (std::size_t length = 0; length < whole.size() - (is_text ? 1 : 0); ++length) {
            put_text(path("cut.mha"), whole.substr(0, length));
            EXPECT_THAT(refusal({path("cut.mha")}), StartsWith(path("").string())) << length;
        }
    }
}

TEST_F(ReadMetaImageTest, header_that_claims_more_than_can_inflate_is_refused_at_the_door) {
    std::string text = text_of(data("meta/vtk_zlib_uint16.mha"));
    text.replace(text.find("5 4 3"), 5, "50000 40000 300");
    put_text(path("bomb.mha"), text);
    EXPECT_THAT(refusal({path("bomb.mha")}), HasSubstr("cannot hold the 1200000000000"));
}

TEST_F(ReadMetaImageTest, damaged_stream_is_found_by_its_check_sum) {
    std::string text = text_of(data("meta/vtk_zlib_uint16.mha"));
    text.back() = static_cast<char>(text.back() ^ 1);
    put_text(path("bad.mha"), text);
    EXPECT_THAT(refusal({path("bad.mha")}),
                HasSubstr("section 2: the compressed stream is damaged (incorrect data check)"));
}

}  // namespace
}  // namespace regionmesh
