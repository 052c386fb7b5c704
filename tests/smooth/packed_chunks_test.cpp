#include "smooth/packed_chunks.h"

#include <gtest/gtest.h>

#include "support/cone_chunks.h"

namespace regionmesh {
namespace {

std::vector<LatticeVertex> vertices_of(const Chunk& chunk) {
    std::vector<LatticeVertex> vertices;
    for (std::size_t v = 0; v < chunk.vertices.size(); ++v)
        vertices.push_back({simplex_of(chunk.simplices[v]), chunk.vertices[v].sides});
    return vertices;
}

TEST(PackedChunks, gives_chunks_back_bit_for_bit_in_a_third_of_the_bytes) {
    for (const CellKind cells : {CellKind::kCompact, CellKind::kTetrahedra}) {
        test::ArrayVolume volume = test::grain_volume({40, 40, 12}, 30, 3);
        volume.lattice().spacing = {0.7, 1.3, 5.1};
        volume.lattice().origin = {-7.3, 100.1, 0.7};
        const LatticeFrame frame{volume.info().lattice.origin, volume.info().lattice.spacing};
        const std::vector<Chunk> chunks = test::cone_chunks(volume, cells);
        PackedChunks packed;
        std::size_t plain = 0;
        for (const Chunk& chunk : chunks) {
            packed.push_back(chunk, vertices_of(chunk));
            plain += chunk.vertices.size() * sizeof(ChunkVertex) + chunk.faces.size() * sizeof(ChunkFace);
        }
        EXPECT_LT(packed.bytes(), plain / 3);
        ASSERT_EQ(packed.end(), chunks.size());
        packed.drop_before(3);
        PackedChunks::Parts parts;
        for (std::uint32_t n = 3; n < packed.end(); ++n) {
            packed.unpack(n, parts);
            EXPECT_EQ(parts.carried, chunks[n].carried);
            EXPECT_EQ(parts.active, chunks[n].active);
            ASSERT_EQ(parts.vertices.size(), chunks[n].vertices.size());
            for (std::size_t v = 0; v < parts.vertices.size(); ++v) {
                EXPECT_EQ(centroid_in(parts.vertices[v].simplex, frame), chunks[n].vertices[v].position);
                EXPECT_EQ(parts.vertices[v].sides, chunks[n].vertices[v].sides);
            }
            ASSERT_EQ(parts.faces.size(), chunks[n].faces.size());
            for (std::size_t f = 0; f < parts.faces.size(); ++f) {
                EXPECT_EQ(parts.faces[f].vertices, chunks[n].faces[f].vertices);
                EXPECT_EQ(parts.faces[f].labels, chunks[n].faces[f].labels);
            }
        }
        packed.drop_before(packed.end());
        EXPECT_EQ(packed.bytes(), 0u);
    }
}

TEST(PackedChunks, keeps_large_labels_and_far_numbers) {
    Chunk chunk;
    const std::uint32_t far = 4'000'000'000u;
    chunk.carried = 7;
    chunk.active = {far, 0, 5};
    chunk.faces = {{{far, 0, 3}, {0xFFFFFFEFu, exterior(3)}},
                   {{1, far, 2}, {exterior(3), 12}},
                   {{2, 1, far}, {0xFFFFFFEFu, exterior(3)}},
                   {{0, 1, 2}, {12, 0xFFFFFFEFu}},
                   {{0, 1, 2}, {exterior(3), 12}}};
    PackedChunks packed;
    packed.push_back(chunk, {});
    PackedChunks::Parts parts;
    packed.unpack(0, parts);
    EXPECT_EQ(parts.active, chunk.active);
    ASSERT_EQ(parts.faces.size(), chunk.faces.size());
    for (std::size_t f = 0; f < parts.faces.size(); ++f) {
        EXPECT_EQ(parts.faces[f].vertices, chunk.faces[f].vertices);
        EXPECT_EQ(parts.faces[f].labels, chunk.faces[f].labels);
    }
}

}  // namespace
}  // namespace regionmesh
