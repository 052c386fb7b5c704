#include "smooth/surface_window.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "smooth/chunk_stars.h"

namespace regionmesh {
namespace {

using testing::ElementsAre;

/// A ribbon along z: chunk n adds vertices 2 n and 2 n + 1, and from the second on two faces back to the chunk before.
Chunk chunk_of_ribbon(std::uint32_t n) {
    Chunk chunk;
    for (double x : {0.0, 1.0}) chunk.vertices.push_back({{x, 0, double(n)}});
    chunk.active = {0, 1};
    if (n == 0) return chunk;
    chunk.carried = 2;
    chunk.faces = {{{0, 1, 2}, {0, 1}}, {{1, 3, 2}, {0, 1}}};
    chunk.active = {2, 3};
    return chunk;
}

SurfaceWindow ribbon(std::uint32_t chunks) {
    SurfaceWindow window;
    for (std::uint32_t n = 0; n < chunks; ++n) window.add(chunk_of_ribbon(n));
    return window;
}

TEST(SurfaceWindow, knows_what_each_chunk_added) {
    const SurfaceWindow window = ribbon(4);
    EXPECT_EQ(window.chunk_end(), 4u);
    EXPECT_EQ(window.faces_of(0).size(), 0u);
    EXPECT_EQ(window.faces_of(3).first, 4u);
    EXPECT_EQ(window.faces_of(3).end, 6u);
    EXPECT_EQ(window.vertices_of(3).first, 6u);
    EXPECT_EQ(window.vertices_of(3).end, 8u);
}

TEST(SurfaceWindow, keeps_numbers_when_chunks_are_released) {
    SurfaceWindow window = ribbon(200);
    const std::size_t whole = window.bytes();
    window.drop_before(0);
    for (std::uint32_t chunk : {1u, 2u, 150u, 199u}) {
        window.drop_before(chunk);
        EXPECT_EQ(window.chunk_end(), 200u);
        EXPECT_EQ(window.vertices_of(199).end, 400u);
        EXPECT_EQ(window.faces_of(chunk).first, 2 * chunk - 2);
        for (std::uint32_t f = window.faces_of(chunk).first; f < window.faces_of(chunk).end; ++f)
            for (std::uint32_t v : window.faces[f].vertices)
                EXPECT_EQ(window.origin[v].z, v / 2) << "the chunk before has the first vertices of this one";
    }
    EXPECT_LT(window.bytes(), whole / 20);
    window.add(chunk_of_ribbon(200));
    EXPECT_EQ(window.vertices_of(200).first, 400u);
    EXPECT_EQ(window.vertices_of(200).size(), 2u);
    EXPECT_EQ(window.faces[398].vertices, (std::array<std::uint32_t, 3>{398, 399, 400}));
}

TEST(SurfaceWindow, gives_back_each_chunk_with_other_positions) {
    SurfaceWindow window = ribbon(50);
    SlidingArray<Vec3> positions;
    for (std::uint32_t v = 0; v < 100; ++v) positions.push_back({0, double(v), 0});
    Chunk out;
    for (std::uint32_t n : {0u, 1u, 49u}) {
        const Chunk in = chunk_of_ribbon(n);
        window.drop_before(n);
        window.copy_out(n, positions, out);
        EXPECT_EQ(out.carried, in.carried);
        EXPECT_EQ(out.active, in.active);
        ASSERT_EQ(out.faces.size(), in.faces.size());
        for (std::size_t f = 0; f < in.faces.size(); ++f) EXPECT_EQ(out.faces[f].vertices, in.faces[f].vertices);
        ASSERT_EQ(out.vertices.size(), 2u);
        EXPECT_EQ(out.vertices[1].position, (Vec3{0, 2.0 * n + 1, 0}));
    }
}

TEST(ChunkStars, hold_the_corners_of_two_chunks) {
    const SurfaceWindow window = ribbon(3);
    const ChunkStars stars(window, 1);
    EXPECT_EQ(stars.vertices().first, 2u);
    EXPECT_EQ(stars.vertices().size(), 2u);
    // Vertex 2 is the last of faces 0 and 1, and the first of face 2.
    EXPECT_THAT(stars.of(2), ElementsAre(0 << 2 | 2, 1 << 2 | 2, 2 << 2 | 0));
    EXPECT_THAT(stars.of(3), ElementsAre(1 << 2 | 1, 2 << 2 | 1, 3 << 2 | 0));
}

TEST(ChunkStars, are_the_same_when_the_chunks_before_were_released) {
    SurfaceWindow window = ribbon(30);
    const ChunkStars before(window, 20);
    window.drop_before(20);
    const ChunkStars after(window, 20);
    for (std::uint32_t v : {40u, 41u}) EXPECT_TRUE(std::ranges::equal(before.of(v), after.of(v)));
}

TEST(ChunkStars, of_a_vertex_without_faces_are_empty) {
    SurfaceWindow window = ribbon(2);
    window.add({.carried = 2, .vertices = {{}}, .faces = {}, .active = {}});
    EXPECT_TRUE(ChunkStars(window, 2).of(4).empty());
}

}  // namespace
}  // namespace regionmesh
