#include "stream/merger.h"

#include <gtest/gtest.h>

#include "cells/strip_mesher.h"
#include "simplify/collapse_edges.h"
#include "support/digest.h"
#include "support/runs.h"
#include "volume/section_window.h"

namespace regionmesh {
namespace {

/// Meshes a volume strip by strip; after each strip calls visit(model, merger, z of the last section).
template <class Visit>
Mesh merged(test::ArrayVolume volume, Visit&& visit) {
    LabelTable labels;
    SectionWindow window(volume, labels);
    StripMesher mesher(volume.info().lattice, kSweepZ, {});
    Mesh mesh;
    Merger merger(mesh);
    Chunk chunk;
    while (window.advance()) {
        chunk.clear();
        mesher.mesh(window.low(), window.high(), chunk);
        merger.add(chunk);
        visit(mesh, merger, window.sections_read() - 1.0);
    }
    return mesh;
}

test::ArrayVolume grains() { return test::grain_volume({8, 8, 8}, 6, 2); }

TEST(Merger, active_vertices_lie_on_the_last_section_and_are_fixed) {
    merged(grains(), [](const Mesh& mesh, const Merger&, double z) {
        std::uint32_t active = 0;
        test::for_vertices(mesh, [&](VertexId v) {
            const bool is_active = mesh.position(v).z == z && z < 7;
            EXPECT_EQ(mesh[v].is_fixed, is_active);
            active += is_active;
        });
        EXPECT_EQ(active == 0, z == 7) << "at the end no vertex is active";
    });
}

TEST(Merger, makes_no_vertex_twice) {
    const Mesh mesh = merged(grains(), [](const Mesh&, const Merger&, double) {});
    test::expect_sound(check(mesh));
}

TEST(Merger, follows_active_vertices_that_got_new_ids) {
    const Mesh plain = merged(grains(), [](const Mesh&, const Merger&, double) {});
    const Mesh sorted =
        merged(grains(), [](Mesh& mesh, Merger& merger, double) { merger.renumber(mesh.sort_spatially()); });
    EXPECT_EQ(test::surface_digest(sorted), test::surface_digest(plain));
    test::expect_sound(check(sorted));
}

TEST(Merger, puts_together_what_it_took_apart) {
    const Mesh plain = merged(grains(), [](const Mesh&, const Merger&, double) {});
    const Mesh again = merged(grains(), [](Mesh& mesh, Merger& merger, double) {
        const std::size_t active = merger.active_count();
        const Chunk whole = merger.take_apart();
        EXPECT_EQ(whole.active.size(), active);
        EXPECT_EQ(mesh.face_count(), 0u);
        merger.add(whole);
    });
    EXPECT_EQ(test::surface_digest(again), test::surface_digest(plain));
}

TEST(Merger, merges_into_a_mesh_that_was_decimated_up_to_its_active_vertices) {
    const Mesh mesh = merged(grains(), [](Mesh& part, Merger& merger, double z) {
        merger.renumber(part.sort_spatially());
        collapse_edges(part, {}, {.limits = box_of({.high = z}, 2)});
    });
    test::expect_sound(check(mesh));
    EXPECT_LT(mesh.face_count(), merged(grains(), [](const Mesh&, const Merger&, double) {}).face_count() / 2);
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
