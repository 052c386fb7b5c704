// Faces are turned where neighbours disagree, and sound models stay as they are.
#include <gtest/gtest.h>

#include <random>

#include "formats/surface/file_surface.h"
#include "regionmesh/mesh_arrays.h"
#include "support/runs.h"

namespace regionmesh {
namespace {

using Faces = std::vector<std::array<std::uint32_t, 3>>;

FileSurface surface_of(test::ArrayVolume volume, const std::vector<InputLabel>& background) {
    const Reconstruction made = test::run(volume, {.background = background});
    std::vector<Label> dense;
    for (const InputLabel label : background) dense.push_back(made.labels.find(label).value());
    const MeshArrays arrays = export_arrays(made.mesh, made.labels, dense);
    FileSurface surface;
    surface.points = arrays.points;
    surface.faces = arrays.faces;
    surface.labels = arrays.labels;
    surface.exterior_label = arrays.exterior_label;
    return surface;
}

Faces oriented(FileSurface surface, const std::function<bool()>& turns) {
    for (auto& face : surface.faces)
        if (turns()) std::swap(face[1], face[2]);
    orient_faces(surface);
    return surface.faces;
}

test::ArrayVolume boxes(const test::Size& size, const std::function<InputLabel(std::array<std::uint32_t, 3>)>& label) {
    std::vector<InputLabel> labels;
    for (std::uint32_t z = 0; z < size[2]; ++z)
        for (std::uint32_t y = 0; y < size[1]; ++y)
            for (std::uint32_t x = 0; x < size[0]; ++x) labels.push_back(label({x, y, z}));
    return {size, labels};
}

TEST(OrientFaces, regions_on_the_box_beside_a_background_are_closed_and_it_is_not) {
    const std::vector<test::ArrayVolume> volumes{
        boxes({6, 6, 6}, [](auto p) { return p[0] >= 3; }),
        boxes({6, 6, 6}, [](auto p) { return p[0] == 2 || p[0] == 3; }),
        boxes({6, 6, 6}, [](auto p) { return p[0] < 2 && p[1] < 2 && p[2] < 2; }),
        test::grain_volume({12, 10, 11}, 6, 3),
    };
    std::mt19937 random(1);
    for (const test::ArrayVolume& volume : volumes) {
        const FileSurface sound = surface_of(volume, {0});
        EXPECT_EQ(oriented(sound, [] { return false; }), sound.faces);
        EXPECT_EQ(oriented(sound, [] { return true; }), sound.faces);
        EXPECT_EQ(oriented(sound, [&] { return random() % 2 == 0; }), sound.faces);
    }
}

TEST(OrientFaces, islands_in_noise_keep_their_orientation) {
    for (std::uint32_t seed = 0; seed < 20; ++seed) {
        const FileSurface sound = surface_of(test::noise_volume({5, 4, 6}, 2 + seed % 3, seed), {0});
        EXPECT_EQ(oriented(sound, [] { return false; }), sound.faces) << seed;
    }
}

TEST(OrientFaces, a_cavity_is_turned_as_the_surface_round_it) {
    const FileSurface sound = surface_of(boxes({9, 9, 9},
                                               [](auto p) {
                                                   const auto [low, high] = std::minmax({p[0], p[1], p[2]});
                                                   const std::uint32_t depth = std::min(low, 8 - high);
                                                   return depth == 4 ? 2 : depth == 2 || depth == 3 ? 0 : 1;
                                               }),
                                         {});
    EXPECT_EQ(oriented(sound, [] { return false; }), sound.faces);
    EXPECT_EQ(oriented(sound, [] { return true; }), sound.faces);
}

/// Cubes of 1 and 2 in each other: each is as right as the one round it.
TEST(OrientFaces, many_parts_round_each_other_are_decided_one_after_the_other) {
    constexpr std::uint32_t kCubes = 2000;
    constexpr std::array<std::array<std::uint32_t, 3>, 12> kOutward{{{0, 2, 1},
                                                                     {1, 2, 3},
                                                                     {4, 5, 6},
                                                                     {5, 7, 6},
                                                                     {0, 1, 4},
                                                                     {1, 5, 4},
                                                                     {2, 6, 3},
                                                                     {3, 6, 7},
                                                                     {0, 4, 2},
                                                                     {2, 4, 6},
                                                                     {1, 3, 5},
                                                                     {3, 7, 5}}};
    FileSurface sound;
    for (std::uint32_t n = 0; n < kCubes; ++n) {
        const double half = 1 + n;
        for (int corner = 0; corner < 8; ++corner)
            sound.points.push_back({corner & 1 ? half : -half, corner & 2 ? half : -half, corner & 4 ? half : -half});
        for (const auto& face : kOutward) {
            sound.faces.push_back({8 * n + face[0], 8 * n + face[1], 8 * n + face[2]});
            const InputLabel outside = n + 1 == kCubes ? sound.exterior_label : 1 + (n + 1) % 2;
            sound.labels.push_back({1 + n % 2, outside});
        }
    }
    EXPECT_EQ(oriented(sound, [] { return false; }), sound.faces);
    EXPECT_EQ(oriented(sound, [] { return true; }), sound.faces);
}

/// A cube of 2 in the mouth of a U of 1: neither is inside the other one, though its box is.
TEST(OrientFaces, an_island_in_a_bay_is_no_cavity) {
    const FileSurface sound =
        surface_of(boxes({11, 11, 11},
                         [](auto p) {
                             const auto [x, y, z] = p;
                             const auto within = [](std::uint32_t n, std::uint32_t low, std::uint32_t high) {
                                 return n >= low && n <= high;
                             };
                             if (x == 5 && y == 5 && z == 5) return 2;
                             const bool is_block = within(x, 1, 8) && within(y, 1, 8) && within(z, 1, 8);
                             return is_block && !(within(x, 3, 7) && y >= 3 && within(z, 3, 7)) ? 1 : 0;
                         }),
                   {0});
    for (const InputLabel inverted : {-1, 1, 2, 3}) {
        FileSurface surface = sound;
        for (std::size_t f = 0; f < surface.faces.size(); ++f)
            if (inverted == 3 || std::ranges::count(surface.labels[f], inverted) > 0)
                std::swap(surface.faces[f][1], surface.faces[f][2]);
        orient_faces(surface);
        EXPECT_EQ(surface.faces, sound.faces) << inverted;
    }
}

}  // namespace
}  // namespace regionmesh
