#include "regionmesh/mesh_arrays.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "base/box.h"
#include "regionmesh/error.h"
#include "regionmesh/simplify.h"
#include "regionmesh/smooth.h"
#include "support/labels.h"
#include "support/runs.h"
#include "support/shapes.h"

namespace regionmesh {
namespace {

using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;

Reconstruction grains(InputLabel first = 0) { return test::run(test::grain_volume({8, 7, 6}, 5, 4, first)); }

void expect_equal(const MeshArrays& a, const MeshArrays& b) {
    EXPECT_EQ(a.points, b.points);
    EXPECT_EQ(a.faces, b.faces);
    EXPECT_EQ(a.labels, b.labels);
    EXPECT_EQ(a.node_types, b.node_types);
    EXPECT_EQ(a.exterior_label, b.exterior_label);
    EXPECT_EQ(a.is_unsigned, b.is_unsigned);
}

TEST(MeshArrays, come_back_as_the_same_mesh) {
    const Reconstruction made = grains();
    const MeshArrays arrays = export_arrays(made.mesh, made.labels);
    EXPECT_EQ(arrays.points.size(), made.mesh.vertex_count());
    EXPECT_EQ(arrays.faces.size(), made.mesh.face_count());
    const LabelledMesh back = import_arrays(arrays);
    expect_equal(export_arrays(back.mesh, back.labels), arrays);
    EXPECT_EQ(back.mesh.vertex_count(), made.mesh.vertex_count());
    for (std::uint32_t v = 0; v < back.mesh.vertex_end(); ++v)
        EXPECT_EQ(back.mesh[VertexId{v}].sides, made.mesh[VertexId{v}].sides) << "sides of the box are found again";
    test::expect_sound(check(back.mesh));
}

TEST(MeshArrays, of_several_backgrounds_have_their_open_rims_on_the_sides) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        test::ArrayVolume volume = test::noise_volume({4, 3, 5}, 4, seed);
        const Reconstruction made =
            test::run(volume, {.smooth = {.passes = 0}, .decimate = false, .background = {0, 2}});
        const MeshArrays arrays = export_arrays(made.mesh, made.labels, made.background);
        LabelledMesh back = import_arrays(arrays);
        const std::vector<Label> background{back.labels.dense(0), back.labels.dense(2)};
        test::expect_sound(check(back.mesh, {.background = background}));
    }
}

TEST(MeshArrays, of_an_open_model_have_their_rims_on_the_sides) {
    test::ArrayVolume volume = test::grain_volume({14, 12, 10}, 9, 3);
    const Reconstruction made =
        test::run(volume, {.smooth = {.passes = 0}, .decimate = false, .cap = false, .background = {}});
    LabelledMesh back = import_arrays(export_arrays(made.mesh, made.labels));
    for (std::uint32_t v = 0; v < back.mesh.vertex_end(); ++v)
        EXPECT_EQ(back.mesh[VertexId{v}].sides, made.mesh[VertexId{v}].sides);
    const MeshArrays before = export_arrays(back.mesh, back.labels);
    fix_rims(back.mesh);
    smooth(back.mesh, {.filter = SmoothFilter::kTaubin, .passes = 20});
    const MeshArrays after = export_arrays(back.mesh, back.labels);
    std::uint32_t moved = 0;
    for (std::size_t n = 0; n < before.points.size(); ++n) {
        const bool has_moved = after.points[n] != before.points[n];
        EXPECT_FALSE(has_moved && before.node_types[n] >= 10);
        moved += has_moved;
    }
    EXPECT_GT(moved, 100u);
    for (std::uint32_t v = 0; v < back.mesh.vertex_end(); ++v) back.mesh[VertexId{v}].is_fixed = false;
    const Box box{{0, 0, 0}, {13, 11, 9}};
    simplify(back.mesh, {.target_faces = back.mesh.face_count() / 5, .promises = {.box = box}, .bounds_regions = true});
    test::expect_sound(check(back.mesh, {.boundary_is_open = true}));
    std::uint32_t on_sides = 0;
    for (std::uint32_t v = 0; v < back.mesh.vertex_end(); ++v) {
        if (!back.mesh.is_alive(VertexId{v})) continue;
        const Vec3 p = back.mesh.position(VertexId{v});
        EXPECT_TRUE(is_within(p, box));
        for (int side = 0; side < 6; ++side) {
            if (!(back.mesh[VertexId{v}].sides >> side & 1)) continue;
            EXPECT_EQ(p[side / 2], (side % 2 == 0 ? box.low : box.high)[side / 2]);
            ++on_sides;
        }
    }
    EXPECT_GT(on_sides, 20u);
}

TEST(MeshArrays, of_an_open_model_that_does_not_reach_all_sides_have_their_rims_on_those_that_it_reaches) {
    const test::Size size{8, 7, 9};
    std::vector<InputLabel> flat, waves;
    for (std::uint32_t z = 0; z < size[2]; ++z)
        for (std::uint32_t y = 0; y < size[1]; ++y)
            for (std::uint32_t x = 0; x < size[0]; ++x) {
                flat.push_back(z < 3 ? 1 : z < 5 ? 2 : 3);
                waves.push_back(z < 3 + (x * x + 3 * y) % 4 ? 1 : 2);
            }
    for (const std::vector<InputLabel>& labels : {flat, waves})
        for (const std::uint32_t passes : {0u, 20u}) {
            test::ArrayVolume volume(size, labels);
            const Reconstruction made =
                test::run(volume, {.smooth = {.passes = passes}, .decimate = false, .cap = false, .background = {}});
            const LabelledMesh back = import_arrays(export_arrays(made.mesh, made.labels));
            for (std::uint32_t v = 0; v < back.mesh.vertex_end(); ++v)
                ASSERT_EQ(back.mesh[VertexId{v}].sides, made.mesh[VertexId{v}].sides) << v;
        }
}

TEST(MeshArrays, of_a_decimated_open_model_have_no_open_edge_inside) {
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
        const test::ArrayVolume grains = test::grain_volume({11, 4, 4}, 5, seed);
        std::vector<InputLabel> labels = grains.labels();
        std::fill_n(labels.begin(), 11 * 4, 9);  // the lowest section
        test::ArrayVolume volume(grains.size(), labels);
        ReconstructOptions options;
        options.cap = false;
        options.background = {};
        options.reduce = 0.8;
        const Reconstruction made = reconstruct(volume, options);
        const LabelledMesh back = import_arrays(export_arrays(made.mesh, made.labels));
        EXPECT_EQ(check(back.mesh, {.boundary_is_open = true}).violation_count(), 0u) << seed;
    }
}

TEST(MeshArrays, simplify_without_a_file) {
    const Reconstruction made = grains();
    LabelledMesh mesh = import_arrays(export_arrays(made.mesh, made.labels));
    const std::uint32_t before = mesh.mesh.face_count();
    simplify(mesh.mesh, {.target_faces = before / 2});
    const MeshArrays arrays = export_arrays(mesh.mesh, mesh.labels);
    EXPECT_LE(arrays.faces.size(), before / 2);
    test::expect_sound(check(import_arrays(arrays).mesh));
}

TEST(MeshArrays, count_living_vertices_and_faces_only) {
    Mesh mesh = test::octahedron();
    const LabelTable labels = test::labels_from({5, 7});
    mesh.remove_vertex(mesh.add_vertex({9, 9, 9}));
    mesh.add_vertex({8, 8, 8});
    mesh.remove_face(FaceId{0});
    const MeshArrays arrays = export_arrays(mesh, labels);
    EXPECT_EQ(arrays.points.size(), 7u);
    EXPECT_EQ(arrays.faces.size(), 7u);
    EXPECT_EQ(arrays.points[6], (Vec3{8, 8, 8}));
}

TEST(MeshArrays, have_the_smaller_label_first_and_background_second) {
    const Reconstruction made = grains();
    const MeshArrays arrays = export_arrays(made.mesh, made.labels);
    for (const auto& [first, second] : arrays.labels) EXPECT_TRUE(first < second || second == -1);
    const std::vector<Label> background{LabelTable(made.labels).dense(0)};
    for (const auto& [first, second] : export_arrays(made.mesh, made.labels, background).labels) {
        EXPECT_TRUE(first != 0 || second == -1) << "background is second, except before the exterior";
    }
}

TEST(MeshArrays, keep_negative_labels_and_find_another_exterior) {
    const Reconstruction made = grains(-3);
    const MeshArrays arrays = export_arrays(made.mesh, made.labels);
    EXPECT_EQ(arrays.exterior_label, -4);
    const LabelledMesh back = import_arrays(arrays);
    expect_equal(export_arrays(back.mesh, back.labels), arrays);
    for (Label label = 0; label < back.labels.size(); ++label) EXPECT_NE(back.labels.input(label), -4);
}

TEST(MeshArrays, keep_labels_of_64_bits) {
    constexpr auto kHighest = std::numeric_limits<std::int64_t>::max();
    for (const bool is_unsigned : {false, true}) {
        // As unsigned numbers -2 is the greater one.
        const LabelTable labels = test::labels_from({InputLabel{-2}, kHighest}, is_unsigned);
        const MeshArrays arrays = export_arrays(test::octahedron(), labels);
        if (is_unsigned)
            EXPECT_THAT(arrays.labels, Each(ElementsAre(kHighest, -2)));
        else
            EXPECT_THAT(arrays.labels, Each(ElementsAre(-2, kHighest)));
        const LabelledMesh back = import_arrays(arrays);
        EXPECT_EQ(back.labels.is_unsigned(), is_unsigned);
        expect_equal(export_arrays(back.mesh, back.labels), arrays);
    }
}

TEST(MeshArrays, of_node_types_mark_what_lies_on_a_hull) {
    MeshArrays arrays{.points = test::kTetrahedronCorners};
    for (const auto& face : test::tetrahedron_faces()) {
        arrays.faces.push_back({face.v[0], face.v[1], face.v[2]});
        arrays.labels.push_back({1, -1});
    }
    EXPECT_EQ(import_arrays(arrays).mesh[VertexId{3}].sides, 0);
    arrays.node_types = {12, 12, 12, 12};
    EXPECT_EQ(import_arrays(arrays).mesh[VertexId{3}].sides, kOnHull);
}

std::string refusal(const MeshArrays& arrays) {
    try {
        import_arrays(arrays);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::kInput);
        return error.what();
    }
    return "not refused";
}

TEST(MeshArrays, that_contradict_each_other_are_refused) {
    const MeshArrays good{.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, .faces = {{0, 1, 2}}, .labels = {{1, 2}}};
    EXPECT_EQ(refusal(good), "not refused");
    MeshArrays bad = good;
    bad.labels.clear();
    EXPECT_THAT(refusal(bad), HasSubstr("1 faces, but 0 pairs of labels"));
    bad = good;
    bad.faces[0][2] = 3;
    EXPECT_THAT(refusal(bad), HasSubstr("face 0 names point 3 of 3"));
    bad = good;
    bad.points[1].y = NAN;
    EXPECT_THAT(refusal(bad), HasSubstr("point 1 is not finite"));
    bad = good;
    bad.node_types = {2};
    EXPECT_THAT(refusal(bad), HasSubstr("node types"));
}

}  // namespace
}  // namespace regionmesh
