#include <gmock/gmock.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "formats/surface/written_meshes.h"
#include "surface/region_colours.h"

namespace regionmesh {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Pair;

const LabelColours kGiven{{7, 0xFF8000}, {99, 0x010203}};

class WriteColours : public WriterTest {
protected:
    std::string nested_in(const std::string& name, const WriteOptions& options) const {
        return written(nested(), nested_labels(), name, options);
    }
    static std::uint32_t palette_colour_of_5() {
        static const Mesh mesh = nested();
        static const LabelTable labels = nested_labels();
        FileView view(mesh, labels, {2});
        view.set_given_colours(kGiven);
        return region_colours(view)[view.rank(0)];
    }
};

TEST_F(WriteColours, given_ones_are_kept_in_models) {
    for (const std::string name : {"m.vtp", "m.vtu", "m.ply", "m.obj"}) {
        SCOPED_TRACE(name);
        nested_in(name, {.background = {2}, .colours = kGiven});
        EXPECT_THAT(read_mesh(path(name)).colours, ElementsAre(Pair(7, 0xFF8000u)));
        nested_in(name, {.background = {2}});
        EXPECT_THAT(read_mesh(path(name)).colours, IsEmpty()) << "those of the palette are not given";
    }
}

TEST_F(WriteColours, obj_has_an_object_and_a_material_for_each_region) {
    const std::string text = nested_in("m.obj", {.background = {2}, .names = {{7, "the core"}}, .colours = kGiven});
    EXPECT_THAT(text, HasSubstr("\nmtllib m.mtl\n"));
    EXPECT_THAT(text, HasSubstr("\no region_5\nusemtl region_5\ng interface_5_0\n"));
    EXPECT_THAT(text, HasSubstr("\no the_core\nusemtl the_core\ng interface_7_5\n"));
    EXPECT_EQ(count_of(text, "\no "), 2u);
    const std::string materials = text_of(path("m.mtl"));
    EXPECT_THAT(materials, HasSubstr("newmtl the_core\nKd 1 0.502 0\n"));
    EXPECT_EQ(count_of(materials, "newmtl "), 2u);
}

TEST_F(WriteColours, obj_stands_only_beside_its_materials) {
    std::filesystem::create_directory(path("m.mtl"));
    EXPECT_ANY_THROW(require_writable_mesh(path("m.obj")));
    EXPECT_ANY_THROW(nested_in("m.obj", {.background = {2}}));
    EXPECT_FALSE(std::filesystem::exists(path("m.obj")));
    EXPECT_EQ(file_count(), 1);
}

TEST_F(WriteColours, obj_of_a_name_that_is_no_line_is_refused) {
    EXPECT_ANY_THROW(require_writable_mesh(path("m\nf 1 1 1.obj")));
    EXPECT_ANY_THROW(require_writable_mesh(path("m\\.obj")));
    EXPECT_NO_THROW(require_writable_mesh(path("a model's.obj")));
}

TEST_F(WriteColours, ply_has_the_colour_of_the_region_behind_each_face) {
    const std::string text = nested_in("m.ply", {.background = {2}, .colours = kGiven});
    EXPECT_THAT(text, HasSubstr("property int label_second\nproperty uchar red\nproperty uchar green\nproperty uchar "
                                "blue\nend_header\n"));
    constexpr std::size_t kFaceBytes = 1 + 3 * 4 + 2 * 4 + 3, kFaces = 24;
    ASSERT_GT(text.size(), kFaceBytes * kFaces);
    const std::array<std::uint8_t, 3> five = rgb_of(palette_colour_of_5());
    for (std::size_t n = 0; n < kFaces; ++n) {  // the smaller label is first: all faces are those of region 5
        const std::string colour = text.substr(text.size() - n * kFaceBytes - 3, 3);
        for (std::size_t part = 0; part < 3; ++part) EXPECT_EQ(static_cast<std::uint8_t>(colour[part]), five[part]);
    }
}

TEST_F(WriteColours, of_files_per_region_are_those_of_the_model) {
    nested_in("m.ply", {.background = {2}, .colours = kGiven, .per_region = true});
    EXPECT_THAT(text_of(path("m-7.ply")), testing::EndsWith("\xFF\x80" + std::string(1, '\0')));
    const std::string five = text_of(path("m-5.ply"));
    EXPECT_EQ(static_cast<std::uint8_t>(five.back()), rgb_of(palette_colour_of_5())[2]);
}

TEST_F(WriteColours, vtk_has_them_as_an_array_of_cells) {
    for (const std::string name : {"m.vtp", "m.vtu"}) {
        const std::string text = nested_in(name, {.background = {2}, .colours = kGiven});
        EXPECT_THAT(text, HasSubstr("<DataArray type=\"UInt8\" Name=\"RGB\" NumberOfComponents=\"3\""));
        EXPECT_THAT(text, HasSubstr("Name=\"RegionColours\" NumberOfComponents=\"3\" NumberOfTuples=\"1\" "
                                    "format=\"ascii\">\n255 128 0\n"));
    }
}

TEST_F(WriteColours, glb_has_given_ones_in_linear_rgb) {
    const std::string bytes = nested_in("m.glb", {.background = {2}, .colours = kGiven});
    const auto json = nlohmann::json::parse(bytes.substr(20, bytes.find("BIN") - 24));
    EXPECT_EQ(json["materials"][1]["pbrMetallicRoughness"]["baseColorFactor"], (nlohmann::json{1, 0.2159, 0, 1}));
}

TEST_F(WriteColours, arrays_of_another_shape_are_no_colours) {
    const std::string text = nested_in("m.vtp", {.background = {2}, .colours = kGiven});
    const auto colours_with = [&](const std::string& from, const std::string& to) {
        std::string changed = text;
        changed.replace(changed.find(from), from.size(), to);
        std::ofstream(path("m.vtp")) << changed;
        return read_mesh(path("m.vtp")).colours;
    };
    const std::string array = "Name=\"RegionColours\" NumberOfComponents=\"3\" NumberOfTuples=\"1\"";
    EXPECT_THAT(colours_with(array, array), testing::SizeIs(1));
    EXPECT_THAT(colours_with("\"RegionColours\" NumberOfComponents=\"3\"", "\"RegionColours\""), IsEmpty());
    EXPECT_THAT(colours_with(array, "Name=\"RegionColours\" NumberOfComponents=\"3\" NumberOfTuples=\"2\""), IsEmpty());
    EXPECT_THAT(colours_with("\"ColourLabels\"", "\"OtherLabels\""), IsEmpty());
}

TEST_F(WriteColours, comments_that_are_no_colours_are_ignored) {
    const std::string text = nested_in("m.obj", {.background = {2}, .colours = kGiven});
    for (const char* bad : {"# colour 7 #ff80", "# colour seven #ff8000", "# colour", "# colour 7 #gg8000"}) {
        std::string changed = text;
        const std::string good = "# colour 7 #ff8000";
        std::ofstream(path("m.obj")) << changed.replace(changed.find(good), good.size(), bad);
        EXPECT_THAT(read_mesh(path("m.obj")).colours, IsEmpty()) << bad;
    }
}

}  // namespace
}  // namespace regionmesh
