#include "smooth/surface_window.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "smooth/stars.h"

namespace regionmesh {
namespace {

using testing::ElementsAre;

/// A ribbon along z: layer n adds vertices 2 n and 2 n + 1, and from the second on two faces back to the layer before.
SurfaceWindow ribbon(std::uint32_t layers) {
    SurfaceWindow window;
    for (std::uint32_t n = 0; n < layers; ++n) {
        for (double x : {0.0, 1.0}) {
            window.origin.push_back({x, 0, double(n)});
            window.sides.push_back(0);
        }
        if (n > 0) {
            window.faces.push_back({{2 * n - 2, 2 * n - 1, 2 * n}, {0, 1}});
            window.faces.push_back({{2 * n - 1, 2 * n + 1, 2 * n}, {0, 1}});
        }
        window.end_layer();
    }
    return window;
}

TEST(SurfaceWindow, knows_what_each_layer_added) {
    const SurfaceWindow window = ribbon(4);
    EXPECT_EQ(window.layer_end(), 4u);
    EXPECT_EQ(window.faces_of(0).size(), 0u);
    EXPECT_EQ(window.faces_of(3).first, 4u);
    EXPECT_EQ(window.faces_of(3).end, 6u);
    EXPECT_EQ(window.vertices_of(3).first, 6u);
    EXPECT_EQ(window.vertices_of(3).end, 8u);
}

TEST(SurfaceWindow, keeps_numbers_when_layers_are_let_go) {
    SurfaceWindow window = ribbon(200);
    const std::size_t whole = window.bytes();
    window.drop_before(0);
    for (std::uint32_t layer : {1u, 2u, 150u, 199u}) {
        window.drop_before(layer);
        EXPECT_EQ(window.layer_end(), 200u);
        EXPECT_EQ(window.vertices_of(199).end, 400u);
        EXPECT_EQ(window.faces_of(layer).first, 2 * layer - 2);
        for (std::uint32_t f = window.faces_of(layer).first; f < window.faces_of(layer).end; ++f)
            for (std::uint32_t v : window.faces[f].vertices)
                EXPECT_EQ(window.origin[v].z, v / 2) << "the layer before has the first vertices of this one";
    }
    EXPECT_LT(window.bytes(), whole / 20);
    window.origin.push_back({0, 0, 200});
    window.sides.push_back(0);
    window.end_layer();
    EXPECT_EQ(window.vertices_of(200).first, 400u);
    EXPECT_EQ(window.vertices_of(200).size(), 1u);
}

TEST(LayerStars, hold_the_corners_of_two_layers) {
    const SurfaceWindow window = ribbon(3);
    const LayerStars stars(window, 1);
    EXPECT_EQ(stars.vertices().first, 2u);
    EXPECT_EQ(stars.vertices().size(), 2u);
    // Vertex 2 is the last of faces 0 and 1, and the first of face 2.
    EXPECT_THAT(stars.of(2), ElementsAre(0 << 2 | 2, 1 << 2 | 2, 2 << 2 | 0));
    EXPECT_THAT(stars.of(3), ElementsAre(1 << 2 | 1, 2 << 2 | 1, 3 << 2 | 0));
}

TEST(LayerStars, are_the_same_when_the_layers_before_were_let_go) {
    SurfaceWindow window = ribbon(30);
    const LayerStars before(window, 20);
    window.drop_before(20);
    const LayerStars after(window, 20);
    for (std::uint32_t v : {40u, 41u}) EXPECT_TRUE(std::ranges::equal(before.of(v), after.of(v)));
}

TEST(LayerStars, of_a_vertex_without_faces_are_empty) {
    SurfaceWindow window = ribbon(2);
    window.origin.push_back({});
    window.sides.push_back(0);
    window.end_layer();
    EXPECT_TRUE(LayerStars(window, 2).of(4).empty());
}

}  // namespace
}  // namespace regionmesh
