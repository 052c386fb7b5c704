#include <gmock/gmock.h>

#include "formats/array/read_volume.h"
#include "formats/temporary_folder.h"

namespace regionmesh {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::ElementsAreArray;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Pair;
using testing::StartsWith;

class ReadNrrdTest : public TemporaryFolder {
protected:
    /// 5 x 4 x 3 bytes, with a header in which `from` stands as `to`, or has `to` as a line of its own.
    std::filesystem::path nrrd(const std::string& from = "", const std::string& to = "") {
        std::string text = "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 5 4 3\nencoding: raw\n";
        if (from.empty() && !to.empty()) text += to + "\n";
        if (!from.empty()) text.replace(text.find(from), from.size(), to);
        text += "\n";
        for (int v = 0; v < 60; ++v) text += static_cast<char>(v);
        put_text(path("a.nrrd"), text);
        return path("a.nrrd");
    }
    VolumeInfo info_of(const std::filesystem::path& file) { return open_sections({file})->info(); }
};

ReadOptions layer(std::uint32_t number) {
    ReadOptions options;
    options.layer = number;
    return options;
}

TEST_F(ReadNrrdTest, files_of_teem_and_itk_come_back_label_for_label) {
    for (const auto& file : files_in("nrrd")) {
        const std::string name = file.filename();
        if (name.ends_with("raw") || name.ends_with("gz") || name.starts_with("layers") || name.starts_with("two"))
            continue;
        expect_as_named(file, "nrrd");
    }
}

TEST_F(ReadNrrdTest, raw_files_sweep_along_every_axis_and_others_along_z) {
    EXPECT_THAT(info_of(data("nrrd/raw_uint16.nrrd")).can_sweep, ElementsAre(true, true, true));
    EXPECT_THAT(info_of(data("nrrd/detached_int16.nhdr")).can_sweep, ElementsAre(true, true, true));
    for (const char* name : {"big_gzip_int16.nrrd", "ascii_int16.nrrd", "list_uint16.nhdr"})
        EXPECT_THAT(info_of(data(std::string("nrrd/") + name)).can_sweep, ElementsAre(false, false, true));
}

TEST_F(ReadNrrdTest, the_unit_of_length_is_one_that_all_axes_have) {
    const auto metres = [&](const std::string& line) { return info_of(nrrd("", line)).metres; };
    EXPECT_EQ(metres("space units: \"mm\" \"mm\" \"mm\""), 1e-3);
    EXPECT_EQ(metres("units: \"micrometers\" \"\" \"micrometers\""), 1e-6);
    for (const char* line : {"units: \"mm\" \"mm\" \"cm\"", "units: \"\" \"\" \"\"", "units: \"s\"", "units: \"mm", ""})
        EXPECT_EQ(metres(line), std::nullopt) << line;
}

TEST_F(ReadNrrdTest, text_has_as_many_numbers_as_its_sizes_say) {
    const auto text = [&](const std::string& numbers) {
        put_text(path("a.nrrd"), "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 2 1 2\nencoding: ascii\n\n" + numbers);
        return Paths{path("a.nrrd")};
    };
    EXPECT_EQ(read_volume(text("1 2 3 4\n \n")).labels, (std::vector<InputLabel>{1, 2, 3, 4}));
    EXPECT_THAT(refusal(text("1 2 3\n")), HasSubstr("the numbers end early"));
    EXPECT_THAT(refusal(text("1 2 3 4\n5\n")), HasSubstr("'5' stands behind the last number that the size asks for"));
}

TEST_F(ReadNrrdTest, places_in_space_are_those_of_the_header) {
    expect_in_space(info_of(data("nrrd/flipped_uint8.nrrd")), {10, -20, 30}, {-0.5, 0, 0, 0, -0.75, 0, 0, 0, 2});
    for (const char* name : {"nrrd/oblique_uint16.nrrd", "nrrd/itk_uint16.nrrd"})
        expect_in_space(info_of(data(name)), {10, -20, 30}, {0.3, -0.6, 0, 0.4, 0.45, 0, 0, 0, -2});
    expect_in_space(info_of(data("nrrd/spacings_int8.nrrd")), {0, 0, 0}, {0.5, 0, 0, 0, 0.75, 0, 0, 0, 2});
    expect_in_space(info_of(data("nrrd/raw_uint8.nrrd")), {0, 0, 0}, {1, 0, 0, 0, 1, 0, 0, 0, 1});
    // Mins and maxs of cells span one sample more than those of nodes.
    expect_in_space(info_of(data("nrrd/hand_from_end_uint8.nrrd")), {0.25, 10, 0}, {0.5, 0, 0, 0, 4. / 3, 0, 0, 0, 1});
    expect_in_space(info_of(nrrd("", "spacings: -0.5 nan 2")), {0, 0, 0}, {-0.5, 0, 0, 0, 1, 0, 0, 0, 2});
}

TEST_F(ReadNrrdTest, another_spacing_moves_samples_of_cells_as_if_the_header_had_it) {
    const std::string ends = "axis mins: 0 1 0\naxis maxs: 10 13 27";
    expect_in_space(info_of(nrrd("", ends)), {1, 2.5, 4.5}, {2, 0, 0, 0, 3, 0, 0, 0, 9});
    expect_in_space(open_sections({nrrd("", ends)}, spaced({2, 3, 4}))->info(), {1, 2.5, 2},
                    {2, 0, 0, 0, 3, 0, 0, 0, 4});
    expect_in_space(open_sections({nrrd("", ends + "\ncenters: node node cell")}, spaced({2, 3, 4}))->info(), {0, 1, 2},
                    {2, 0, 0, 0, 3, 0, 0, 0, 4});
}

TEST_F(ReadNrrdTest, las_is_turned_into_lps) {
    const std::string where = "\nspace directions: (0.3,0.4,0) (-0.6,0.45,0) (0,0,2)\nspace origin: (10,-20,30)";
    for (const char* name : {"left-anterior-superior", "LAS"}) {
        const VolumeInfo info = info_of(nrrd("", std::string("space: ") + name + where));
        EXPECT_EQ(info.space, Space::kLps);
        expect_in_space(info, {10, 20, 30}, {0.3, -0.6, 0, -0.4, -0.45, 0, 0, 0, 2});
    }
    EXPECT_EQ(info_of(nrrd("", "space: scanner-xyz" + where)).space, Space::kUnknown);
}

TEST_F(ReadNrrdTest, numbers_as_text_must_be_of_the_type) {
    const auto text = [&](const std::string& type, const std::string& number) {
        put_text(path("t.nrrd"),
                 "NRRD0004\ntype: " + type + "\ndimension: 3\nsizes: 2 1 1\nencoding: text\n\n0 " + number + "\n");
        return path("t.nrrd");
    };
    for (const auto& [type, number] : {std::pair("uint8", "255"),
                                       {"int8", "-128"},
                                       {"int64", "-9223372036854775808"},
                                       {"uint64", "18446744073709551615"},
                                       {"uint32", "-0"}})
        EXPECT_NO_THROW(read_volume({text(type, number)})) << type;
    for (const auto& [type, number] : {std::pair("uint8", "256"),
                                       {"uint8", "-1"},
                                       {"int8", "128"},
                                       {"int16", "-32769"},
                                       {"int64", "9223372036854775808"},
                                       {"uint64", "-1"}})
        EXPECT_THAT(refusal({text(type, number)}),
                    HasSubstr(std::string("'") + number + "' is no number of type " + type));
}

TEST_F(ReadNrrdTest, two_axes_are_one_section) {
    const Volume volume = read_volume({data("nrrd/two_axes_uint8.nrrd")});
    EXPECT_EQ(volume.info.lattice.size, (std::array<std::uint32_t, 3>{5, 4, 1}));
    EXPECT_EQ(volume.labels.size(), 20u);
    EXPECT_EQ(volume.labels[19], 19);
    expect_in_space(volume.info, {1, 2, 0}, {0, -3, 0, 2, 0, 0, 0, 0, 1});
}

TEST_F(ReadNrrdTest, layers_are_read_one_at_a_time_with_the_names_of_their_segments) {
    for (const char* name : {"layers_first_uint8.seg.nrrd", "layers_raw_uint8.seg.nrrd", "layers_last_uint8.nrrd"}) {
        const auto file = data(std::string("nrrd/") + name);
        EXPECT_EQ(read_volume({file}, layer(0)).labels, expected(SampleType::kU8)) << name;
        EXPECT_EQ(read_volume({file}, layer(1)).labels, expected([](InputLabel v) { return 100 + v; })) << name;
        const bool has_segments = file.string().find(".seg.") != std::string::npos;
        EXPECT_THAT(refusal({file}), has_segments ? HasSubstr("has the label 3, of which the file names no segment")
                                                  : HasSubstr("holds 2 layers (kind 'list'), each with labels"));
        EXPECT_THAT(refusal({file}), HasSubstr("--layer"));
        EXPECT_THAT(refusal({file}, layer(2)), HasSubstr("has layers 0 to 1; --layer 2 is none of them"));
    }
    const auto file = data("nrrd/layers_first_uint8.seg.nrrd");
    const Volume low = read_volume({file}, layer(0)), high = read_volume({file}, layer(1));
    EXPECT_THAT(low.info.names, ElementsAre(Pair(1, "low"), Pair(2, "next")));
    EXPECT_THAT(high.info.names, ElementsAre(Pair(101, "high")));
    expect_in_space(high.info, {10, -20, 30}, {-0.5, 0, 0, 0, -0.75, 0, 0, 0, 2});
}

TEST_F(ReadNrrdTest, one_layer_needs_no_choice) {
    const auto file = data("nrrd/one_layer_uint8.seg.nrrd");
    EXPECT_EQ(read_volume({file}, layer(0)).labels, expected(SampleType::kU8));
    EXPECT_THAT(refusal({file}, layer(1)), HasSubstr("--layer 1"));
    EXPECT_THAT(info_of(file).names, ElementsAre(Pair(1, "low"), Pair(2, "next")));
    EXPECT_THAT(refusal({data("npy/uint8.npy")}, layer(1)), HasSubstr("has one layer, 0; --layer 1 is none"));
}

TEST_F(ReadNrrdTest, segments_without_label_values_are_layers_with_label_1) {
    EXPECT_THAT(
        info_of(nrrd("", "Segment0_Name:=bone \xE9\nSegment1_Name:=fat\nSegmentation_Name:=x\nSegment2_Name:=")).names,
        ElementsAre(Pair(1, "bone \xC3\xA9")));
}

TEST_F(ReadNrrdTest, segments_have_colours) {
    const auto colours_of = [&](const std::string& rest) { return info_of(nrrd("", rest)).colours; };
    const std::string segment = "Segment0_Name:=bone\nSegment0_LabelValue:=7\nSegment0_Layer:=0\nSegment0_Color:=";
    EXPECT_THAT(colours_of(segment + "1 0.5 0"), ElementsAre(Pair(7, 0xFF8000u)));
    for (const char* bad : {"1 0.5", "1 0.5 0 1", "1 0.5 1.1", "1 0.5 -0.1", "a b c", "nan 0 0", ""})
        EXPECT_TRUE(colours_of(segment + bad).empty()) << bad;
}

TEST_F(ReadNrrdTest, table_beside_the_file_names_labels_where_no_segments_do) {
    put_text(path("a.txt"), "3 three\n");
    EXPECT_THAT(info_of(nrrd()).names, ElementsAre(Pair(3, "three")));
    put_text(path("a.txt"), "3 three 1 2 3 0\n");
    EXPECT_THAT(info_of(nrrd()).colours, ElementsAre(Pair(3, 0x010203u)));
    EXPECT_THAT(info_of(nrrd("", "Segment0_Name:=bone")).names, ElementsAre(Pair(1, "bone")));
}

TEST_F(ReadNrrdTest, names_of_types_are_read_in_all_spellings) {
    for (const char* type : {"uchar", "unsigned char", "uint8_t", "UINT8"})
        EXPECT_EQ(read_volume({nrrd("uint8", type)}).labels, expected(SampleType::kU8)) << type;
}

TEST_F(ReadNrrdTest, whole_reals_are_labels) {
    EXPECT_EQ(read_volume({data("nrrd/bad/float32.nrrd")}).labels, expected(SampleType::kU8));
}

TEST_F(ReadNrrdTest, bad_files_are_refused_and_say_why) {
    EXPECT_THAT(refusal({nrrd("uint8", "block")}), HasSubstr("samples are 'block'; labels must be integers"));
    EXPECT_THAT(refusal({data("nrrd/bad/bzip2.nrrd")}),
                HasSubstr("encoding 'bzip2' is not read; write it with gzip or raw"));
    EXPECT_THAT(refusal({data("nrrd/bad/hex.nrrd")}), HasSubstr("encoding 'hex'"));
    EXPECT_THAT(refusal({data("nrrd/bad/time.nrrd")}), HasSubstr("holds 2 layers (kind 'time')"));
    const std::pair<std::string, std::string> cases[] = {
        {"sizes: 5 4 0", "sizes is '5 4 0'"},
        {"sizes: 5 4", "one entry for each axis"},
        {"sizes: 5 4 3 1", "one entry for each axis"},
        {"sizes: 5 4 -3", "sizes is"},
        {"sizes: 5 4 2147483648", "more than 2^31 - 1"},
        {"sizes: 2000000000 2000000000 2000000000", "more than any file holds"},
        {"sizes: 5 4 4", "the file holds 60 bytes of samples where its header says 80"},
    };
    for (const auto& [line, message] : cases) EXPECT_THAT(refusal({nrrd("sizes: 5 4 3", line)}), HasSubstr(message));
    EXPECT_THAT(refusal({nrrd("dimension: 3", "dimension: 17")}), HasSubstr("dimension is '17'"));
    EXPECT_THAT(refusal({nrrd("dimension: 3\nsizes: 5 4 3", "dimension: 1\nsizes: 60")}),
                HasSubstr("has 1 axes in space"));
    EXPECT_THAT(refusal({nrrd("NRRD0004", "NRXD0004")}), HasSubstr("not a NRRD file"));
    EXPECT_THAT(refusal({nrrd("uint8", "block")}), HasSubstr("samples are 'block'"));
    EXPECT_THAT(refusal({nrrd("uint8", "int32")}), HasSubstr("'little' or 'big' is needed"));
    EXPECT_THAT(refusal({nrrd("", "space directions: (1,0,0) (0,1,0) (1,1,0)\nspace: RAS")}),
                HasSubstr("no affine map"));
    EXPECT_THAT(refusal({nrrd("", "space directions: (1,0,0) (0,1,0)")}), HasSubstr("vector or 'none' for each axis"));
    EXPECT_THAT(refusal({nrrd("", "space directions: (1,0,0) (0,1,0) (0,0)")}), HasSubstr("vectors in space"));
    EXPECT_THAT(refusal({nrrd("", "spacings: 1 1 0")}), HasSubstr("no affine map"));
    EXPECT_THAT(refusal({nrrd("", "spacings: 1 1 inf")}), HasSubstr("numbers are needed"));
    EXPECT_THAT(refusal({nrrd("", "byte skip: -2")}), HasSubstr("byteskip is '-2'"));
    EXPECT_THAT(refusal({nrrd("", "byte skip: 1")}), HasSubstr("truncated"));
    EXPECT_THAT(refusal({nrrd("", "line skip: 9")}), HasSubstr("lines before its samples"));
    EXPECT_THAT(refusal({nrrd("", "kinds: list list domain")}), HasSubstr("2 others of more than one sample"));
}

TEST_F(ReadNrrdTest, data_files_that_do_not_fit_are_refused) {
    const auto detached = [&](const std::string& data_file) {
        return std::filesystem::path(nrrd("", "data file: " + data_file));
    };
    EXPECT_THAT(refusal({detached("gone.raw")}),
                AllOf(HasSubstr("gone.raw: no such file"), EndsWith("header, " + detached("gone.raw").string())));
    EXPECT_THAT(refusal({detached("LIST")}), HasSubstr("lists no files"));
    EXPECT_THAT(refusal({detached("z%d.raw 1 2 0")}), HasSubstr("never comes to its last number"));
    EXPECT_THAT(refusal({detached("z%d.raw 8 7 5")}), HasSubstr("never comes to its last number"));
    EXPECT_THAT(refusal({detached("z%d.raw 7 8 -5")}), HasSubstr("never comes to its last number"));
    EXPECT_THAT(refusal({detached("z%d.raw 1 9999999999 1")}), HasSubstr("more than a million files"));
    EXPECT_THAT(refusal({detached("z%d.raw 1 3 1")}), HasSubstr("z1.raw: no such file"));
    put_text(path("z1.raw"), std::string(30, 'a'));
    put_text(path("z2.raw"), std::string(30, 'b'));
    EXPECT_THAT(read_volume({detached("z%d.raw 1 2 1")}).labels,
                ElementsAreArray(expected([](InputLabel v) { return v < 30 ? 'a' : 'b'; })));
    EXPECT_THAT(read_volume({detached("z%d.raw 2 1 -1")}).labels,
                ElementsAreArray(expected([](InputLabel v) { return v < 30 ? 'b' : 'a'; })));
    put_text(path("z2.raw"), std::string(29, 'b'));
    EXPECT_THAT(refusal({detached("z%d.raw 1 2 1")}),
                AllOf(HasSubstr("z2.raw: "), HasSubstr("has 29 bytes of samples"), HasSubstr("names too few files")));
    EXPECT_THAT(refusal({detached("z%s.raw 1 2 1")}), HasSubstr("a pattern has one number"));
    const auto wide = [&](const std::string& data_file) {
        return nrrd("type: uint8", "type: uint16\nendian: little\ndata file: " + data_file);
    };
    for (int n = 1; n <= 8; ++n) put_text(path("z" + std::to_string(n) + ".raw"), std::string(15, 'c'));
    EXPECT_THAT(refusal({wide("z%d.raw 1 8 1")}), HasSubstr("names 8 files for 5 x 4 x 3 samples"))
        << "7.5 samples each";
}

TEST_F(ReadNrrdTest, file_cut_anywhere_is_refused) {
    for (const char* name : {"oblique_uint16.nrrd", "flipped_uint8.nrrd", "layers_first_uint8.seg.nrrd"}) {
        const std::string whole = text_of(data(std::string("nrrd/") + name));
        for (std::size_t length = 0; length < whole.size(); ++length) {
            put_text(path("cut.nrrd"), whole.substr(0, length));
            EXPECT_THAT(refusal({path("cut.nrrd")}, layer(0)), StartsWith(path("cut.nrrd").string())) << length;
        }
    }
}

TEST_F(ReadNrrdTest, header_that_claims_more_than_can_inflate_is_refused_at_the_door) {
    std::string text = text_of(data("nrrd/flipped_uint8.nrrd"));
    text.replace(text.find("5 4 3"), 5, "50000 40000 300");
    put_text(path("bomb.nrrd"), text);
    EXPECT_THAT(refusal({path("bomb.nrrd")}), HasSubstr("cannot hold the 600000000000"));
}

}  // namespace
}  // namespace regionmesh
