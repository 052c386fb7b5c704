#include "simplify/sweep/flat_vertices.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "base/triangle.h"
#include "mesh/strata.h"
#include "support/runs.h"
#include "support/strata_list.h"

namespace regionmesh {
namespace {

using test::run;

std::uint32_t remove_flat(Mesh& mesh, std::uint32_t target_faces = 0) {
    count_labels(mesh);
    const Promises promises;
    Judge judge(mesh, promises, {.sees_others = false});
    return remove_flat_vertices(judge, target_faces);
}

Mesh block() { return run(test::solid_volume({12, 12, 12})).mesh; }
Mesh nine_grains() { return run(test::grain_volume({14, 14, 14}, 9, 5)).mesh; }

/// The area of the faces of each pair of labels, and what they enclose with the origin.
std::map<std::array<Label, 2>, std::array<double, 2>> sizes(const Mesh& mesh) {
    std::map<std::array<Label, 2>, std::array<double, 2>> sums;
    for (std::uint32_t f = 0; f < mesh.face_end(); ++f) {
        if (!mesh.is_alive(FaceId{f})) continue;
        const auto p = mesh.corners(FaceId{f});
        const Vec3 area = area_vector(p[0], p[1], p[2]);
        auto& [own_area, volume] = sums[mesh[FaceId{f}].labels];
        own_area += length(area);
        volume += dot(area, p[0]);
    }
    return sums;
}

TEST(FlatVertices, nearly_all_inside_the_sides_of_a_block_go) {
    Mesh mesh = block();
    const std::uint32_t faces = mesh.face_count(), vertices = mesh.vertex_count();
    const std::uint32_t removed = remove_flat(mesh);
    EXPECT_EQ(mesh.face_count(), faces - 2 * removed);
    EXPECT_EQ(mesh.vertex_count(), vertices - removed);
    EXPECT_LT(mesh.face_count(), faces / 4);
    test::expect_sound(check(mesh));
}

TEST(FlatVertices, the_surface_stays_the_same_set_of_points) {
    for (auto* make : {block, nine_grains}) {
        Mesh mesh = make();
        const auto before = sizes(mesh);
        const test::StrataList strata = test::list_strata(mesh);
        EXPECT_GT(remove_flat(mesh), 0u);
        const auto after = sizes(mesh);
        ASSERT_EQ(after.size(), before.size());
        for (const auto& [labels, own] : before)
            for (int n = 0; n < 2; ++n) EXPECT_NEAR(after.at(labels)[n], own[n], 1e-9 * std::abs(own[0]));
        test::expect_same_strata(test::list_strata(mesh), strata);
        test::expect_sound(check(mesh));
        for (std::uint32_t v = 0; v < mesh.vertex_end(); ++v) EXPECT_EQ(mesh[VertexId{v}].error_bound(), 0);
    }
}

TEST(FlatVertices, fixed_ones_keep_their_faces) {
    Mesh mesh = block();
    std::map<std::uint32_t, std::set<FaceId>> stars;
    for (std::uint32_t v = 0; v < mesh.vertex_end(); v += 7) {
        mesh[VertexId{v}].is_fixed = true;
        mesh.for_star(VertexId{v}, [&](FaceId f, int) { stars[v].insert(f); });
    }
    EXPECT_GT(remove_flat(mesh), 0u);
    for (const auto& [v, star] : stars) {
        ASSERT_TRUE(mesh.is_alive(VertexId{v}));
        std::set<FaceId> left;
        mesh.for_star(VertexId{v}, [&](FaceId f, int) { left.insert(f); });
        EXPECT_LE(left.size(), star.size());
        for (FaceId f : left) EXPECT_TRUE(star.contains(f)) << "vertex " << v << " has got a face";
    }
    test::expect_sound(check(mesh));
}

TEST(FlatVertices, none_go_where_the_plane_is_square_to_no_axis_or_the_target_is_near) {
    Mesh tilted = block();
    for (std::uint32_t v = 0; v < tilted.vertex_end(); ++v) {
        Vec3& p = tilted[VertexId{v}].position;
        p = {p.x + 0.1 * p.y + 0.2 * p.z, p.y - 0.3 * p.x + 0.1 * p.z, p.z + 0.4 * p.x - 0.2 * p.y};
    }
    EXPECT_EQ(remove_flat(tilted), 0u);
    Mesh near = block();
    EXPECT_EQ(remove_flat(near, near.face_count() * 2 / 3), 0u);
}

TEST(FlatVertices, of_a_sheet_that_ends_the_rim_stays) {
    std::vector<test::TextVolume::Section> sections(4, test::TextVolume::Section(8, "11111111"));
    sections.resize(8, test::TextVolume::Section(8, "22222222"));
    ReconstructOptions options = test::plain();
    options.cap = false;
    Mesh mesh = run(test::TextVolume(sections), options).mesh;
    std::set<VertexId> rim;
    for (std::uint32_t v = 0; v < mesh.vertex_end(); ++v)
        if (mesh[VertexId{v}].sides != 0) rim.insert(VertexId{v});
    ASSERT_FALSE(rim.empty());
    EXPECT_GT(remove_flat(mesh), 0u);
    for (VertexId v : rim) EXPECT_TRUE(mesh.is_alive(v));
}

}  // namespace
}  // namespace regionmesh
