#include "stream/merger.h"

#include <gtest/gtest.h>

#include <array>
#include <utility>
#include <vector>

#include "cells/strip_mesher.h"
#include "simplify/collapse_edges.h"
#include "support/digest.h"
#include "support/runs.h"
#include "volume/section_window.h"

namespace regionmesh {
namespace {

/// Meshes a volume strip by strip; after each strip calls visit(merger, z of the last section).
template <class Visit>
Mesh merged(test::ArrayVolume volume, Visit&& visit) {
    LabelTable labels;
    SectionWindow window(volume, labels);
    StripMesher mesher(volume.info().lattice, kSweepZ, {});
    Merger merger;
    Chunk chunk;
    while (window.advance()) {
        chunk.clear();
        mesher.mesh(window.low(), window.high(), chunk);
        merger.add(chunk);
        visit(merger, window.sections_read() - 1.0);
    }
    return merger.take_mesh();
}

test::ArrayVolume few_grains() { return test::grain_volume({8, 8, 8}, 6, 2); }
Mesh merged_grains() {
    return merged(few_grains(), [](const Merger&, double) {});
}

TEST(Merger, active_vertices_lie_on_the_last_section_and_are_fixed) {
    merged(few_grains(), [](Merger& merger, double z) {
        Mesh mesh = merger.take_sorted_mesh(1);
        std::uint32_t active = 0;
        test::for_vertices(mesh, [&](VertexId v) {
            const bool is_active = mesh.position(v).z == z && z < 7;
            EXPECT_EQ(mesh[v].is_fixed, is_active);
            active += is_active;
        });
        EXPECT_EQ(active == 0, z == 7) << "at the end no vertex is active";
        merger.put_back(mesh);
        EXPECT_EQ(merger.active_count(), active);
    });
}

TEST(Merger, makes_no_vertex_twice) { test::expect_sound(check(merged_grains())); }

TEST(Merger, a_sorted_mesh_may_be_put_back) {
    const Mesh again = merged(few_grains(), [](Merger& merger, double) {
        Mesh mesh = merger.take_sorted_mesh(2);
        EXPECT_EQ(merger.face_count(), 0u);
        merger.put_back(mesh);
        EXPECT_EQ(mesh.face_count(), 0u);
    });
    EXPECT_EQ(test::surface_digest(again), test::surface_digest(merged_grains()));
    test::expect_sound(check(again));
}

TEST(Merger, puts_together_what_it_took_apart) {
    const Mesh again = merged(few_grains(), [](Merger& merger, double z) {
        if (static_cast<int>(z) % 3 != 0) return;
        const std::uint32_t active = merger.active_count();
        const std::uint64_t faces = merger.face_count();
        Chunk whole = merger.take_chunk();
        EXPECT_EQ(whole.active.size(), active);
        EXPECT_EQ(whole.faces.size(), faces);
        EXPECT_EQ(merger.face_count(), 0u);
        merger.add(std::move(whole));
    });
    EXPECT_EQ(test::surface_digest(again), test::surface_digest(merged_grains()));
}

TEST(Merger, merges_into_a_mesh_that_was_decimated_up_to_its_active_vertices) {
    const Mesh mesh = merged(few_grains(), [](Merger& merger, double z) {
        Mesh part = merger.take_sorted_mesh(1);
        collapse_edges(part, {}, {.limits = box_of({.high = z}, 2)});
        merger.put_back(part);
    });
    test::expect_sound(check(mesh));
    EXPECT_LT(mesh.face_count(), merged_grains().face_count() / 2);
}

/// Three chunks of one face each. The second and the third raise error bounds of vertices that they carry.
std::array<Chunk, 3> strip_of_faces() {
    const auto vertex = [](double x, double y, float bound) { return ChunkVertex{{x, y, 0}, 0, bound}; };
    return {Chunk{.vertices = {vertex(0, 0, 0), vertex(1, 0, 0), vertex(0, 1, 2)},
                  .faces = {{{0, 1, 2}, {0, 1}}},
                  .active = {2, 1}},
            Chunk{.carried = 2,
                  .vertices = {vertex(1, 1, 0)},
                  .faces = {{{1, 2, 0}, {0, 1}}},
                  .active = {0, 2},
                  .carried_bounds = {1, 3}},
            Chunk{.carried = 2,
                  .vertices = {vertex(0, 2, 0)},
                  .faces = {{{0, 1, 2}, {1, 0}}},
                  .active = {},
                  .carried_bounds = {4, 0.5F}}};
}

TEST(Merger, error_bounds_of_carried_vertices_rise) {
    const std::array<float, 5> bounds{0, 3, 4, 0.5F, 0};
    for (const bool as_chunk : {false, true}) {
        Merger merger;
        for (const Chunk& chunk : strip_of_faces()) merger.add(chunk);
        if (as_chunk) merger.add(merger.take_chunk());
        const Mesh mesh = merger.take_mesh();
        ASSERT_EQ(mesh.vertex_count(), 5u);
        for (std::uint32_t v = 0; v < 5; ++v) EXPECT_EQ(mesh[VertexId{v}].error_bound(), bounds[v]) << v;
        EXPECT_EQ(mesh[FaceId{1}].vertices, (std::array{VertexId{1}, VertexId{3}, VertexId{2}}));
        EXPECT_EQ(mesh[FaceId{2}].vertices, (std::array{VertexId{2}, VertexId{4}, VertexId{3}}))
            << "the smaller label comes first";
    }
}

TEST(Chunk, appended_chunks_raise_bounds_of_vertices_that_both_carry) {
    auto [first, second, third] = strip_of_faces();
    second.append(third);
    EXPECT_EQ(second.carried, 2u);
    EXPECT_EQ(second.carried_bounds, (std::vector<float>{4, 3}));
    EXPECT_EQ(second.vertices[0].error_bound, 0.5F);
    first.append(second);
    EXPECT_EQ(first.vertices[1].error_bound, 3);
    EXPECT_EQ(first.vertices[2].error_bound, 4);
}

TEST(SectionWindow, hands_out_consecutive_sections_with_dense_labels) {
    test::TextVolume volume({{"77", "77"}, {"75", "77"}, {"99", "55"}});
    LabelTable labels;
    SectionWindow window(volume, labels);
    ASSERT_TRUE(window.advance());
    EXPECT_EQ(std::vector(window.low().begin(), window.low().end()), (std::vector<Label>{0, 0, 0, 0}));
    EXPECT_EQ(std::vector(window.high().begin(), window.high().end()), (std::vector<Label>{0, 1, 0, 0}));
    EXPECT_FALSE(window.is_last());
    ASSERT_TRUE(window.advance());
    EXPECT_EQ(std::vector(window.low().begin(), window.low().end()), (std::vector<Label>{0, 1, 0, 0}));
    EXPECT_EQ(std::vector(window.high().begin(), window.high().end()), (std::vector<Label>{2, 2, 1, 1}));
    EXPECT_TRUE(window.is_last());
    EXPECT_FALSE(window.advance());
    EXPECT_EQ(labels.input(2), 9);
}

TEST(SectionWindow, reads_ahead_and_leaves_the_strip_as_it_is) {
    const auto copy = [](std::span<const Label> section) { return std::vector(section.begin(), section.end()); };
    test::TextVolume volume({{"77", "77"}, {"75", "77"}, {"99", "55"}});
    LabelTable labels;
    SectionWindow window(volume, labels);
    ASSERT_TRUE(window.advance());
    const std::vector<Label> low = copy(window.low()), high = copy(window.high());
    EXPECT_EQ(copy(window.read_ahead()), (std::vector<Label>{2, 2, 1, 1}));
    EXPECT_EQ(copy(window.read_ahead()), (std::vector<Label>{2, 2, 1, 1})) << "one section, however often asked";
    EXPECT_EQ(copy(window.low()), low);
    EXPECT_EQ(copy(window.high()), high);
    EXPECT_FALSE(window.is_last());
    ASSERT_TRUE(window.advance());
    EXPECT_EQ(copy(window.low()), high);
    EXPECT_EQ(copy(window.high()), (std::vector<Label>{2, 2, 1, 1}));
    EXPECT_TRUE(window.is_last());
    EXPECT_TRUE(window.read_ahead().empty());
    EXPECT_FALSE(window.advance());
}

}  // namespace
}  // namespace regionmesh
