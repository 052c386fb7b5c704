#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <tuple>

#include "formats/surface/mesh_formats.h"
#include "formats/temporary_folder.h"
#include "regionmesh/error.h"
#include "support/paths.h"

namespace regionmesh {
namespace {

using testing::HasSubstr;

class ReadVtp : public TemporaryFolder {
protected:
    std::string failure_of_text(const std::string& name, const std::string& text) {
        put_text(path(name), text);
        try {
            read_vtp(path(name));
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::kInput);
            EXPECT_THAT(error.what(), HasSubstr(name));
            return error.what();
        }
        return "nothing thrown";
    }
};

TEST_F(ReadVtp, damaged_vtk_files_are_refused_or_read_but_never_crash) {
    constexpr std::size_t kStride = 11;  // a prime, so that over the files all columns of the encodings are met
    for (const auto& entry : std::filesystem::directory_iterator(test::data_folder())) {
        if (!entry.path().filename().string().starts_with("vtp_")) continue;
        const std::string good = text_of(entry.path());
        for (std::size_t i = 0; i < good.size(); i += kStride) {
            std::string bad = good;
            bad[i] = static_cast<char>(bad[i] ^ (i % 2 == 0 ? '\x80' : '\x03'));
            for (const std::string& text : {bad, good.substr(0, i)}) {
                put_text(path("bad.vtp"), text);
                try {
                    read_vtp(path("bad.vtp"));
                } catch (const Error&) {
                }
            }
        }
    }
}

// A triangle 0-1-2 of region 3 against 5, written by hand.
std::string vtp_text(const std::string& from = "", const std::string& to = "") {
    std::string text = R"(<VTKFile type="PolyData" version="0.1" byte_order="LittleEndian"><PolyData>
<Piece NumberOfPoints="3" NumberOfVerts="0" NumberOfPolys="1"><Points>
<DataArray type="Float32" NumberOfComponents="3" format="ascii">0 0 0 1 0 0 0.5 1e0 0</DataArray></Points>
<Polys><DataArray type="Int32" Name="connectivity" format="ascii">0 1 2</DataArray>
<DataArray type="UInt8" Name="offsets" format="ascii">3</DataArray></Polys>
<CellData><DataArray type="Int16" Name="BoundaryLabels" NumberOfComponents="2" format="ascii">3 5</DataArray></CellData>
</Piece></PolyData></VTKFile>)";
    if (!from.empty()) text.replace(text.find(from), from.size(), to);
    return text;
}

TEST_F(ReadVtp, hand_written_file_is_read) {
    put_text(path("m.vtp"), vtp_text());
    const FileSurface surface = read_vtp(path("m.vtp"));
    EXPECT_EQ(surface.points[2], (Vec3{0.5, 1, 0}));
    EXPECT_THAT(surface.faces, testing::ElementsAre(std::array{0u, 1u, 2u}));
    EXPECT_THAT(surface.labels, testing::ElementsAre(std::array<InputLabel, 2>{3, 5}));
    EXPECT_EQ(surface.exterior_label, -1);
}

TEST_F(ReadVtp, pieces_follow_one_another) {
    const std::string text = vtp_text();
    const std::size_t begin = text.find("<Piece"), end = text.find("</PolyData>");
    const std::string piece = text.substr(begin, end - begin);
    put_text(path("m.vtp"), vtp_text("</PolyData>", "<Piece NumberOfPoints=\"0\"/>" + piece + "</PolyData>"));
    const FileSurface surface = read_vtp(path("m.vtp"));
    EXPECT_THAT(surface.faces, testing::ElementsAre(std::array{0u, 1u, 2u}, std::array{3u, 4u, 5u}));
    EXPECT_EQ(surface.points.size(), 6u);
    EXPECT_THAT(surface.labels, testing::Each(std::array<InputLabel, 2>{3, 5}));
}

TEST_F(ReadVtp, polygons_are_cut_and_each_triangle_has_their_labels) {
    std::string text = vtp_text("NumberOfPoints=\"3\"", "NumberOfPoints=\"6\"");
    const auto put = [&](const std::string& from, const std::string& to) {
        text.replace(text.find(from), from.size(), to);
    };
    put("NumberOfPolys=\"1\"", "NumberOfPolys=\"3\"");
    // A quad twice, from one corner and the next, and a pentagon.
    put("0 0 0 1 0 0 0.5 1e0 0", "0 0 0 3 0 0 3 1 0 1 1 0 6 0 0 -1 0.5 0");
    put(">0 1 2<", ">0 1 2 3 3 0 1 2 0 1 2 3 5<");
    put(">3</DataArray></Polys>", ">4 8 13</DataArray></Polys>");
    put(">3 5<", ">1 2 3 4 5 6<");
    put_text(path("m.vtp"), text);
    const FileSurface surface = read_vtp(path("m.vtp"));
    using Face = std::array<std::uint32_t, 3>;
    using Pair = std::array<InputLabel, 2>;
    EXPECT_THAT(surface.faces, testing::ElementsAre(Face{3, 1, 2}, Face{0, 1, 3}, Face{3, 1, 2}, Face{0, 1, 3},
                                                    Face{3, 5, 0}, Face{3, 0, 1}, Face{1, 2, 3}));
    EXPECT_THAT(surface.labels, testing::ElementsAre(Pair{1, 2}, Pair{1, 2}, Pair{3, 4}, Pair{3, 4}, Pair{5, 6},
                                                     Pair{5, 6}, Pair{5, 6}));
}

TEST_F(ReadVtp, unsigned_labels_keep_their_bits) {
    std::string text = vtp_text("Int16", "UInt64");
    put_text(path("m.vtp"), text.replace(text.find("3 5<"), 3, "9223372036854775808 18446744073709551615"));
    EXPECT_THAT(read_vtp(path("m.vtp")).labels,
                testing::ElementsAre(std::array<InputLabel, 2>{std::numeric_limits<InputLabel>::min(), -1}));
}

TEST_F(ReadVtp, errors_name_what_is_wrong) {
    const std::tuple<std::string, std::string, std::string> cases[] = {
        {"Components=\"2\"", "Components=\"3\"", "has 3 components: 2 are needed"},
        {"Int16", "Float64", "array 'BoundaryLabels': has type 'Float64': integers are needed"},
        {"3 5<", "3<", "array 'BoundaryLabels': has 1 numbers, and more are needed"},
        {"3 5<", "3 5 6<", "array 'BoundaryLabels': has more numbers"},
        {"3 5<", "3 5x<", "has '5x' where a whole number belongs"},
        {">3</DataArray></Polys>", ">2</DataArray></Polys>", "cell 0 is no polygon: its offset is 2 after 0"},
        {">3</DataArray></Polys>", ">4</DataArray></Polys>",
         "array 'connectivity': has 3 numbers, and more are needed"},
        {"0 1 2<", "0 1 3<", "cell 0 names point 3 of 3"},
        {"0 1 2<", "0 1 -1<", "cell 0 names point -1 of 3"},
        {"1e0", "nan", "point 2 has a coordinate that is not finite"},
        {"NumberOfVerts=\"0\"", "NumberOfVerts=\"1\"", "NumberOfVerts is not 0"},
        {"NumberOfPolys=\"1\"", "NumberOfPolys=\"-1\"", "NumberOfPolys is '-1'"},
        {"NumberOfPolys=\"1\"", "NumberOfPolys=\"99999999999\"",
         "NumberOfPolys is '99999999999': a count of at most 1073741823"},
        {"NumberOfPoints=\"3\"", "NumberOfPoints=\"4000000000\"", "array '': has 9 numbers, and more are needed"},
        {"NumberOfVerts=\"0\"", "NumberOfStrips=\"1\"", "NumberOfStrips is not 0"},
        {"type=\"PolyData\"", "type=\"PolyData\" compressor=\"vtkLZ4DataCompressor\"",
         "compressor 'vtkLZ4DataCompressor': write it with zlib"},
        {"<PolyData>", "<Poly>", "no XML"},
    };
    for (const auto& [from, to, message] : cases)
        EXPECT_THAT(failure_of_text("m.vtp", vtp_text(from, to)), HasSubstr(message));
    EXPECT_THAT(failure_of_text("m.vtp", "<VTKFile><ImageData/></VTKFile>"),
                HasSubstr("no VTK XML file with PolyData"));
    EXPECT_THAT(failure_of_text("m.vtp", ""), HasSubstr("no XML"));
}

TEST_F(ReadVtp, sizes_are_held_against_what_is_there) {
    const std::string points = "format=\"ascii\">0 0 0 1 0 0 0.5 1e0 0";
    // The header of the first promises 4 GiB, of the second 2^31 blocks, of the third one block of 2 GiB in 8 bytes, of
    // the fourth the 36 bytes that are needed in 8, which are no zlib stream.
    EXPECT_THAT(failure_of_text("m.vtp", vtp_text(points, "format=\"binary\">/////w==AAAA")),
                HasSubstr("has 4294967295 bytes"));
    EXPECT_THAT(failure_of_text("m.vtp", vtp_text(points, "format=\"binary\">JAAAAA==AAAA")), HasSubstr("ends early"));
    const std::string zlib = "compressor=\"vtkZLibDataCompressor\"";
    const auto compressed = [&](const std::string& text) {
        std::string whole = vtp_text(points, "format=\"binary\">" + text);
        return whole.insert(whole.find("version"), zlib + " ");
    };
    EXPECT_THAT(failure_of_text("m.vtp", compressed("AAAAgAAAAAAAAAAAAAAAAA==")),
                HasSubstr("table of its blocks is cut short"));
    EXPECT_THAT(failure_of_text("m.vtp", compressed("AQAAAAAAAIAAAAAACAAAAA==AAAAAAAAAAA=")),
                HasSubstr("has 536870912 numbers where 9 are needed"));
    EXPECT_THAT(failure_of_text("m.vtp", compressed("AQAAACQAAAAAAAAACAAAAA==AAAAAAAAAAA=")),
                HasSubstr("block is damaged"));
    EXPECT_THAT(failure_of_text("m.vtp", compressed("!")), HasSubstr("table of its blocks is cut short"));
}

}  // namespace
}  // namespace regionmesh
