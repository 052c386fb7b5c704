#include <gmock/gmock.h>

#include "formats/array/read_volume.h"
#include "formats/temporary_folder.h"

namespace regionmesh {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pair;
using testing::StartsWith;

class ReadVtiTest : public TemporaryFolder {
protected:
    /// A file of VTK's with `from` replaced by `to`.
    std::filesystem::path changed(const std::string& name, const std::string& from, const std::string& to) {
        std::string text = text_of(data("vti/" + name));
        text.replace(text.find(from), from.size(), to);
        put_text(path("a.vti"), text);
        return path("a.vti");
    }
    VolumeInfo info_of(const std::filesystem::path& file) { return open_sections({file})->info(); }
};

TEST_F(ReadVtiTest, vtks_files_come_back_label_for_label) {
    for (const auto& file : files_in("vti"))
        if (!file.filename().string().starts_with("flat")) expect_as_named(file, "vti");
}

TEST_F(ReadVtiTest, raw_appended_arrays_sweep_along_every_axis_and_others_along_z) {
    EXPECT_THAT(info_of(data("vti/raw_plain_32_uint8.vti")).can_sweep, ElementsAre(true, true, true));
    for (const char* name :
         {"raw_zlib_64_uint8.vti", "base64_plain_64_uint8.vti", "binary_plain_32_uint8.vti", "ascii_uint8.vti"})
        EXPECT_THAT(info_of(data(std::string("vti/") + name)).can_sweep, ElementsAre(false, false, true));
}

TEST_F(ReadVtiTest, places_in_space_are_those_of_the_header) {
    expect_in_space(info_of(data("vti/raw_uint8.vti")), {10, -20, 30}, {0.5, 0, 0, 0, 0.75, 0, 0, 0, 2});
    // The extent begins at (-2, 10, 7): the first sample lies there.
    expect_in_space(info_of(data("vti/turned_uint8.vti")), {10 - 0.6 - 6, -20 - 0.8 + 4.5, 30 - 14},
                    {0.3, -0.6, 0, 0.4, 0.45, 0, 0, 0, -2});
}

TEST_F(ReadVtiTest, samples_of_cells_lie_at_their_centres) {
    const VolumeInfo info = info_of(data("vti/cells_uint16.vti"));
    EXPECT_EQ(info.lattice.size, (std::array<std::uint32_t, 3>{5, 4, 3}));
    expect_in_space(info, {10 + 0.15 - 0.3, -20 + 0.2 + 0.225, 30 - 1}, {0.3, -0.6, 0, 0.4, 0.45, 0, 0, 0, -2});
    const Volume flat = read_volume({data("vti/flat_cells_uint16.vti")});
    EXPECT_EQ(flat.info.lattice.size, (std::array<std::uint32_t, 3>{5, 4, 1}));
    EXPECT_EQ(flat.labels[19], 19);
    expect_in_space(flat.info, {0.5, 0.5, 0}, {1, 0, 0, 0, 1, 0, 0, 0, 1});
}

TEST_F(ReadVtiTest, another_spacing_moves_samples_as_if_the_header_had_it) {
    const VolumeInfo cells = open_sections({data("vti/cells_uint16.vti")}, spaced({1, 2, 3}))->info();
    expect_in_space(cells, {10 + 0.3 - 0.8, -20 + 0.4 + 0.6, 30 - 1.5}, {0.6, -1.6, 0, 0.8, 1.2, 0, 0, 0, -3});
    const VolumeInfo points = open_sections({data("vti/turned_uint8.vti")}, spaced({1, 2, 3}))->info();
    expect_in_space(points, {10 - 1.2 - 16, -20 - 1.6 + 12, 30 - 21}, {0.6, -1.6, 0, 0.8, 1.2, 0, 0, 0, -3});
}

TEST_F(ReadVtiTest, only_integers_with_one_component_are_labels) {
    EXPECT_EQ(read_volume({data("vti/bad/float32.vti")}).labels, expected(SampleType::kU8));
    EXPECT_THAT(refusal({data("vti/bad/several.vti")}),
                AllOf(HasSubstr("several arrays of integers"), HasSubstr("first (points, UInt16)"),
                      HasSubstr("second (points, UInt8)")));
}

TEST_F(ReadVtiTest, comments_and_other_elements_are_passed_over) {
    const std::string line = "<PointData Scalars=\"labels\">";
    EXPECT_EQ(read_volume({changed("raw_uint16.vti", line, "<!-- <DataArray> ' --> <FieldData/>" + line)}).labels,
              expected(SampleType::kU16));
}

TEST_F(ReadVtiTest, table_beside_the_file_names_labels) {
    put_text(path("a.txt"), "3 three\n");
    EXPECT_THAT(info_of(changed("raw_uint16.vti", "0 4 0 3 0 2", "0 4 0 3 0 2")).names, ElementsAre(Pair(3, "three")));
}

TEST_F(ReadVtiTest, bad_files_are_refused_and_say_why) {
    EXPECT_THAT(refusal({data("vti/bad/lz4.vti")}), HasSubstr("compressor 'vtkLZ4DataCompressor': write it with zlib"));
    const std::string extent = "Piece Extent=\"0 4 0 3 0 2\"";
    const std::tuple<std::string, std::string, std::string> cases[] = {
        {extent, "Piece Extent=\"0 4 0 3 0 3\"", "array 'labels': has 120 bytes where its extent needs 160"},
        {extent, "Piece Extent=\"0 4 0 3 3 2\"", "Extent is '0 4 0 3 3 2'"},
        {extent, "Piece Extent=\"-9223372036854775808 4 0 3 0 2\"", "Extent is '-9223372036854775808"},
        {extent, "Piece Extent=\"0 4 0 3\"", "Extent is '0 4 0 3'"},
        {extent, "Piece Extent=\"0 4 0 3 0 9999999999\"", "more than 2^31 - 1"},
        {extent, "Piece Extent=\"0 999999999 0 999999999 0 999999999\"", "more than any file holds"},
        {"Spacing=\"0.5 0.75 2\"", "Spacing=\"0.5 0.75\"", "Spacing is '0.5 0.75': 3 numbers"},
        {"Spacing=\"0.5 0.75 2\"", "Spacing=\"0.5 0.75 0\"", "no affine map"},
        {"Origin=\"10", "Origin=\"nan", "no affine map"},
        {"<ImageData", "<RectilinearGrid", "no XML"},
        {"offset=\"0\"", "offset=\"9999\"", "begins beyond the end of the file"},
        {"offset=\"0\"", "offset=\"-1\"", "begins beyond the end of the file"},
        {"encoding=\"raw\"", "encoding=\"hex\"", "no appended data in raw or base64"},
        {"   _", "   x", "does not begin with an underscore"},
        {"format=\"appended\"", "format=\"else\"", "array format 'else'"},
        {"</Piece>", "</Piece><Piece/>", "has no Piece, or several"},
    };
    for (const auto& [from, to, message] : cases)
        EXPECT_THAT(refusal({changed("raw_uint16.vti", from, to)}), HasSubstr(message)) << to;
    EXPECT_THAT(refusal({changed("zlib_uint16.vti", extent, "Piece Extent=\"0 4 0 3 0 3\"")}),
                HasSubstr("array 'labels': has 120 bytes where its extent needs 160"));
    EXPECT_THAT(refusal({changed("zlib_uint16.vti", extent, "Piece Extent=\"0 9999 0 9999 0 9999\"")}),
                HasSubstr("cannot hold the 2000000000000"));
    EXPECT_THAT(refusal({changed("ascii_uint16.vti", extent, "Piece Extent=\"0 4 0 3 0 99\"")}),
                HasSubstr("fewer numbers than its extent needs"));
    EXPECT_THAT(refusal({changed("ascii_uint16.vti", extent, "Piece Extent=\"0 3 0 3 0 2\"")}),
                HasSubstr("stands behind the last number that the size asks for"));
    EXPECT_THAT(refusal({changed("ascii_uint16.vti", "1 2 3", "1 2.5 3")}), HasSubstr("'2.5' is no label"));
    put_text(path("a.vti"), "<VTKFile><PolyData/></VTKFile>");
    EXPECT_THAT(refusal({path("a.vti")}), HasSubstr("is no VTK XML file with ImageData"));
    put_text(path("a.vti"), "");
    EXPECT_THAT(refusal({path("a.vti")}), HasSubstr("no XML"));
}

TEST_F(ReadVtiTest, damaged_block_is_found_by_its_check_sum) {
    const std::string whole = text_of(data("vti/raw_zlib_32_uint8.vti"));
    const std::size_t begin = whole.find('_', whole.find("<AppendedData")) + 1;
    int refused = 0;
    for (std::size_t i = begin + 20; i < whole.find("\n", begin + 90); ++i, ++refused) {
        std::string bad = whole;
        bad[i] = static_cast<char>(bad[i] ^ 1);
        put_text(path("a.vti"), bad);
        EXPECT_THAT(refusal({path("a.vti")}), HasSubstr("damaged")) << i - begin;
    }
    EXPECT_GT(refused, 50);
}

TEST_F(ReadVtiTest, file_cut_anywhere_before_its_samples_end_is_refused) {
    for (const char* name : {"raw_plain_32_uint8.vti", "raw_zlib_64_uint8.vti", "base64_zlib_32_uint8.vti",
                             "binary_plain_64_uint8.vti", "ascii_uint8.vti"}) {
        const std::string whole = text_of(data(std::string("vti/") + name));
        const bool is_appended = whole.find("</AppendedData>") != std::string::npos;
        const std::size_t end = whole.find(is_appended ? "\n  </AppendedData>" : "</DataArray>");
        for (std::size_t length = 0; length < end; ++length) {
            put_text(path(name), whole.substr(0, length));
            EXPECT_THAT(refusal({path(name)}), StartsWith(path(name).string())) << length;
        }
    }
}

}  // namespace
}  // namespace regionmesh
