// What files of models say of their coordinates.
#include <gmock/gmock.h>

#include "formats/surface/written_meshes.h"

namespace regionmesh {
namespace {

using testing::HasSubstr;

class CoordinatesTest : public WriterTest {
protected:
    Coordinates again(const std::string& name, const Coordinates& coordinates) const {
        written(nested(), nested_labels(), name, {.background = {2}, .coordinates = coordinates});
        return read_mesh(path(name)).coordinates;
    }
};

TEST_F(CoordinatesTest, space_unit_and_spacing_come_back) {
    const Coordinates known{Space::kLps, 0.0254, Vec3{0.1, 1.0 / 3, 7e-300}};
    for (const char* name : {"m.vtp", "m.vtu", "m.ply", "m.obj"}) {
        EXPECT_EQ(again(name, known), known) << name;
        EXPECT_EQ(again(name, {}), Coordinates{}) << name;
        EXPECT_EQ(again(name, {.metres = 1}), (Coordinates{.metres = 1})) << name;
    }
}

TEST_F(CoordinatesTest, lengths_that_are_none_are_not_written) {
    for (const double bad : {0.0, -1.0, std::nan(""), HUGE_VAL}) {
        EXPECT_THROW(again("m.vtp", {.metres = bad}), Error);
        EXPECT_THROW(again("m.vtp", {.spacing = Vec3{1, 1, bad}}), Error);
    }
}

TEST_F(CoordinatesTest, damaged_lengths_are_refused_in_vtk_files_and_passed_over_in_comments) {
    again("m.vtp", {.metres = 0.5, .spacing = Vec3{3, 3, 3}});
    const auto with = [&](const std::string& name, const std::string& from, const std::string& to) {
        std::string text = text_of(path(name));
        text.replace(text.find(from), from.size(), to);
        put_text(path("bad-" + name), text);
        return path("bad-" + name);
    };
    const auto refusal = [](const std::filesystem::path& file) -> std::string {
        try {
            read_mesh(file);
        } catch (const Error& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_THAT(refusal(with("m.vtp", ">0.5<", ">-0.5<")), HasSubstr("MetresPerUnit': has -0.5, which is no length"));
    EXPECT_THAT(refusal(with("m.vtp", ">3 3 3<", ">3 3 nan<")), HasSubstr("SampleSpacing"));
    EXPECT_THAT(refusal(with("m.vtp", ">3 3 3<", ">3 3<")), HasSubstr("SampleSpacing"));
    again("m.obj", {.metres = 0.5, .spacing = Vec3{3, 3, 3}});
    EXPECT_EQ(read_mesh(with("m.obj", "metres_per_unit 0.5", "metres_per_unit of")).coordinates.metres, std::nullopt);
    EXPECT_EQ(read_mesh(with("m.obj", "spacing 3 3 3", "spacing 3 3 -3")).coordinates.spacing, std::nullopt);
}

}  // namespace
}  // namespace regionmesh
