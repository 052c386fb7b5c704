#include "cells/strip_mesher.h"

#include <gtest/gtest.h>

#include <map>

#include "support/runs.h"
#include "support/strata_list.h"

namespace regionmesh {
namespace {

using test::run;

std::map<InputLabel, double> volumes_of(const Reconstruction& made) {
    std::map<InputLabel, double> volumes;
    for (const RegionReport& region : made.report.check.regions)
        volumes[made.labels.input(region.label)] = region.volume;
    return volumes;
}

TEST(StripMesher, one_label_makes_the_box) {
    const Reconstruction flat = run(test::solid_volume({10, 10, 3}));
    EXPECT_EQ(flat.mesh.face_count(), 468u);
    EXPECT_EQ(flat.mesh.vertex_count(), 236u);
    const Reconstruction cube = run(test::solid_volume({8, 8, 8}));
    EXPECT_EQ(cube.mesh.face_count(), 588u);
    EXPECT_EQ(cube.mesh.vertex_count(), 296u);
    test::expect_sound(cube.report.check);
}

TEST(StripMesher, strips_share_the_vertices_of_their_section) {
    const std::vector<Label> section{0, 1, 1, 0, 2, 1, 0, 0, 2};
    StripMesher mesher({.size = {3, 3, 3}}, kSweepZ, {});
    Chunk first, second;
    mesher.mesh(section, section, first);
    mesher.mesh(section, section, second);
    EXPECT_EQ(first.carried, 0u);
    EXPECT_GT(first.active.size(), 0u);
    for (std::uint32_t v : first.active) EXPECT_EQ(first.vertices[v].position.z, 1);
    EXPECT_EQ(second.carried, first.active.size());
    EXPECT_TRUE(second.active.empty()) << "nothing comes after the last strip";
    for (const ChunkVertex& vertex : second.vertices) EXPECT_GT(vertex.position.z, 1);
}

TEST(StripMesher, no_vertex_is_made_twice) {
    for (std::uint64_t seed : {1, 2, 3}) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        const Reconstruction made = run(test::noise_volume({6, 5, 7}, 5, seed));
        EXPECT_EQ(made.report.check.counts[static_cast<int>(ViolationKind::kCoincidentVertices)], 0u);
        EXPECT_EQ(made.report.initial_vertices, made.mesh.vertex_count());
    }
}

TEST(StripMesher, faces_of_noise_have_quality_above_0_138) {
    for (std::uint32_t labels : {2, 4, 30}) {
        SCOPED_TRACE(std::to_string(labels) + " labels, seed 7");
        const Reconstruction made = run(test::noise_volume({12, 12, 12}, labels, 7));
        EXPECT_GT(made.report.check.quality.min, 0.138);
        test::expect_sound(made.report.check);
        test::expect_generic(made.mesh);
    }
}

TEST(StripMesher, sweeps_make_the_same_surface) {
    test::ArrayVolume volume = test::noise_volume({5, 6, 7}, 4, 11).spaced({1, 2, 5});
    const Reconstruction along_z = run(volume);
    for (const Sweep& sweep : {kSweepX, kSweepY}) {
        SCOPED_TRACE("sweep along " + std::to_string(sweep.axes[2]));
        const Reconstruction other = run(volume.swept(sweep));
        EXPECT_EQ(other.mesh.face_count(), along_z.mesh.face_count());
        EXPECT_EQ(other.mesh.vertex_count(), along_z.mesh.vertex_count());
        for (const auto& [label, expected] : volumes_of(along_z))
            EXPECT_NEAR(volumes_of(other).at(label), expected, 1e-9);
        test::expect_sound(other.report.check);
    }
}

TEST(StripMesher, region_volumes_sum_to_the_box) {
    const Reconstruction made = run(test::noise_volume({6, 6, 6}, 3, 5).spaced({1, 2, 5}));
    double sum = 0;
    for (const auto& [label, volume] : volumes_of(made)) sum += volume;
    EXPECT_NEAR(sum, 5.0 * 10 * 25, 1e-9);
}

TEST(StripMesher, positions_are_origin_plus_index_times_spacing) {
    test::ArrayVolume volume = test::solid_volume({3, 3, 3}).spaced({0.1, 0.3, 0.7});
    volume.lattice().origin = {10, -20, 1e6};
    const Reconstruction made = run(volume);
    test::for_vertices(made.mesh, [&](VertexId v) {
        const Vec3 p = made.mesh.position(v);
        bool is_on_lattice = false;
        for (int x = 0; x < 3; ++x)
            for (int y = 0; y < 3; ++y)
                for (int z = 0; z < 3; ++z) is_on_lattice |= p == Vec3{10 + x * 0.1, -20 + y * 0.3, 1e6 + z * 0.7};
        EXPECT_TRUE(is_on_lattice) << p.x << ' ' << p.y << ' ' << p.z;
    });
}

TEST(StripMesher, vertices_know_the_sides_they_lie_on) {
    const test::Size size{4, 5, 6};
    const Reconstruction made = run(test::noise_volume(size, 3, 2));
    test::for_vertices(made.mesh, [&](VertexId v) {
        SideSet sides = 0;
        for (int axis = 0; axis < 3; ++axis) {
            const double x = made.mesh.position(v)[axis];
            if (x == 0) sides |= SideSet(1 << 2 * axis);
            if (x == size[axis] - 1) sides |= SideSet(1 << (2 * axis + 1));
        }
        EXPECT_EQ(made.mesh[v].sides, sides);
    });
}

TEST(StripMesher, an_open_box_has_no_faces_with_the_exterior) {
    test::ArrayVolume volume = test::noise_volume({5, 5, 5}, 3, 4);
    const Reconstruction made = run(volume, {.decimate = false, .cap = false, .background = {}});
    EXPECT_GT(made.mesh.face_count(), 0u);
    test::for_faces(made.mesh, [&](FaceId f) { EXPECT_FALSE(is_exterior(made.mesh[f].labels[1])); });
}

TEST(StripMesher, a_background_has_no_faces_with_the_exterior_but_with_regions) {
    const Reconstruction made = run(test::noise_volume({5, 5, 5}, 3, 4), {.decimate = false, .background = {0}});
    const Label background = made.background.at(0);
    int inner = 0;
    test::for_faces(made.mesh, [&](FaceId f) {
        const auto& labels = made.mesh[f].labels;
        EXPECT_FALSE(labels[0] == background && is_exterior(labels[1]));
        inner += labels[0] == background;
    });
    EXPECT_GT(inner, 0);
    test::expect_sound(made.report.check);
}

}  // namespace
}  // namespace regionmesh
