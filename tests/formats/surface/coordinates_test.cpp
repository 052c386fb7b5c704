// What files of models say of their coordinates.
#include <gmock/gmock.h>

#include "formats/surface/written_meshes.h"
#include "regionmesh/error.h"

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
    const Coordinates known{Space::kLps, 0.0254, Vec3{0.1, 1.0 / 3, 7e-12}};
    for (const char* name : {"m.vtp", "m.vtu", "m.ply", "m.obj"}) {
        EXPECT_EQ(again(name, known), known) << name;
        EXPECT_EQ(again(name, {}), Coordinates{}) << name;
        EXPECT_EQ(again(name, {.metres = 1}), (Coordinates{.metres = 1})) << name;
    }
}

TEST_F(CoordinatesTest, lengths_that_are_none_are_not_written) {
    for (const double bad : {0.0, -1.0, std::nan(""), HUGE_VAL, 1e-300, 1e300}) {
        EXPECT_THROW(again("m.vtp", {.metres = bad}), Error);
        EXPECT_THROW(again("m.vtp", {.spacing = Vec3{1, 1, bad}}), Error);
    }
}

TEST_F(CoordinatesTest, what_is_no_length_or_another_array_is_passed_over) {
    const Coordinates known{.metres = 0.5, .spacing = Vec3{3, 3, 3}};
    const auto with = [&](const std::string& name, const std::string& from, const std::string& to) {
        again(name, known);
        std::string text = text_of(path(name));
        text.replace(text.find(from), from.size(), to);
        put_text(path("other-" + name), text);
        return read_mesh(path("other-" + name)).coordinates;
    };
    for (const char* bad : {"-0.5", "0", "1e-300", "1e300"}) {
        EXPECT_EQ(with("m.vtp", ">0.5<", '>' + std::string(bad) + '<'), (Coordinates{.spacing = known.spacing})) << bad;
        EXPECT_EQ(with("m.obj", "unit 0.5", "unit " + std::string(bad)), (Coordinates{.spacing = known.spacing}))
            << bad;
    }
    EXPECT_EQ(with("m.vtp", ">3 3 3<", ">3 3 0<"), (Coordinates{.metres = 0.5}));
    EXPECT_EQ(with("m.ply", "spacing 3 3 3", "spacing 3 3 x"), (Coordinates{.metres = 0.5}));
    EXPECT_EQ(with("m.vtp", "Name=\"SampleSpacing\" NumberOfComponents=\"3\"", "Name=\"SampleSpacing\""),
              (Coordinates{.metres = 0.5}));
    EXPECT_EQ(with("m.vtu", "type=\"Float64\" Name=\"MetresPerUnit\"", "type=\"String\" Name=\"MetresPerUnit\""),
              (Coordinates{.spacing = known.spacing}));
}

TEST_F(CoordinatesTest, a_folder_has_the_unit_of_its_files_and_a_spacing_that_all_have) {
    const auto folder = [&](const Coordinates& first, const Coordinates& second) {
        std::filesystem::create_directory(path("folder"));
        int n = 0;
        for (const Coordinates& coordinates : {first, second}) {
            Mesh mesh;
            test::add_octahedron(mesh, {10.0 * n, 0, 0}, {1, 1, 1}, 0, 1);
            write_mesh(mesh, test::labels_from({5, 0}), path("folder") / "part.obj",
                       {.background = {1}, .per_region = true, .coordinates = coordinates});
            std::filesystem::rename(path("folder") / "part-5.obj",
                                    path("folder") / ("a" + std::to_string(++n) + ".obj"));
        }
        std::filesystem::remove(path("folder") / "part.mtl");
        return read_mesh(path("folder")).coordinates;
    };
    const Vec3 spacing{1, 1, 4};
    EXPECT_EQ(folder({.metres = 1e-3, .spacing = spacing}, {.metres = 1e-3, .spacing = spacing}),
              (Coordinates{.metres = 1e-3, .spacing = spacing}));
    EXPECT_EQ(folder({.spacing = spacing}, {.metres = 1e-3}), (Coordinates{.metres = 1e-3}));
    EXPECT_EQ(folder({.metres = 1e-3}, {.spacing = spacing}), (Coordinates{.metres = 1e-3}));
    try {
        folder({.metres = 1e-3}, {.metres = 1});
        ADD_FAILURE() << "two units";
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("a2.obj: is in m, and other files of the folder are in mm"));
    }
}

}  // namespace
}  // namespace regionmesh
