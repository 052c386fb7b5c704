#include "regionmesh/mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "regionmesh/check.h"
#include "regionmesh/error.h"
#include "support/digest.h"
#include "support/runs.h"
#include "support/shapes.h"
#include "support/strata_list.h"

namespace regionmesh {
namespace {

std::set<std::uint32_t> star_of(const Mesh& mesh, VertexId v) {
    std::set<std::uint32_t> faces;
    mesh.for_star(v, [&](FaceId f, int place) {
        EXPECT_EQ(mesh[f].vertices[place], v);
        faces.insert(index(f));
    });
    return faces;
}

TEST(Mesh, one_that_was_moved_from_is_empty) {
    Mesh mesh = test::octahedron();
    mesh.remove_face(FaceId{0});
    Mesh other = test::octahedron();
    other = std::move(mesh);
    EXPECT_EQ(other.face_count(), 7u);
    EXPECT_EQ(mesh.face_count() + mesh.face_end() + mesh.vertex_count() + mesh.vertex_end(), 0u);
    for (double x : {0.0, 1.0, 2.0}) mesh.add_vertex({x, x * x, 0});
    mesh.add_face(VertexId{0}, VertexId{1}, VertexId{2}, 0, 1);
    EXPECT_EQ(mesh.face_count(), 1u);
}

/// The stars hold what the faces say.
void expect_stars_of_faces(const Mesh& mesh) {
    std::map<std::uint32_t, std::set<std::uint32_t>> stars;
    std::uint32_t faces = 0, vertices = 0;
    test::for_faces(mesh, [&](FaceId f) {
        ++faces;
        for (VertexId v : mesh[f].vertices) stars[index(v)].insert(index(f));
    });
    test::for_vertices(mesh, [&](VertexId v) {
        ++vertices;
        EXPECT_EQ(star_of(mesh, v), stars[index(v)]);
    });
    EXPECT_EQ(faces, mesh.face_count());
    EXPECT_EQ(vertices, mesh.vertex_count());
}

Mesh grain_mesh() { return test::run(test::grain_volume({7, 7, 7}, 6, 1)).mesh; }

TEST(Mesh, the_smaller_label_comes_first_and_the_face_is_turned) {
    Mesh mesh = test::shape(test::kTetrahedronCorners, {});
    const FaceId f = mesh.add_face(VertexId{0}, VertexId{1}, VertexId{2}, 5, 3);
    EXPECT_EQ(mesh[f].labels, (std::array<Label, 2>{3, 5}));
    EXPECT_EQ(mesh[f].vertices, (std::array{VertexId{0}, VertexId{2}, VertexId{1}}));
}

TEST(Mesh, freed_places_are_used_again) {
    Mesh mesh = test::octahedron();
    test::add_shape(mesh, {{5, 5, 5}}, {});
    mesh.remove_face(FaceId{3});
    mesh.remove_face(FaceId{5});
    mesh.remove_vertex(VertexId{6});
    EXPECT_FALSE(mesh.is_alive(FaceId{3}));
    EXPECT_FALSE(mesh.is_alive(VertexId{6}));
    EXPECT_EQ(mesh.face_count(), 6u);
    EXPECT_EQ(mesh.add_vertex({7, 7, 7}), VertexId{6});
    mesh.add_face(VertexId{0}, VertexId{2}, VertexId{6}, 0, 1);
    mesh.add_face(VertexId{1}, VertexId{2}, VertexId{6}, 0, 1);
    EXPECT_EQ(mesh.face_end(), 8u);
    EXPECT_EQ(mesh.vertex_end(), 7u);
    mesh.add_face(VertexId{1}, VertexId{3}, VertexId{6}, 0, 1);
    EXPECT_EQ(mesh.face_end(), 9u) << "no free place was left";
    expect_stars_of_faces(mesh);
}

TEST(Mesh, removed_faces_leave_the_stars) {
    Mesh mesh = grain_mesh();
    for (std::uint32_t f = 0; f < mesh.face_end(); f += 3) mesh.remove_face(FaceId{f});
    expect_stars_of_faces(mesh);
}

TEST(Mesh, faces_of_what_does_not_exist_are_refused) {
    Mesh mesh;
    const VertexId a = mesh.add_vertex({}), b = mesh.add_vertex({1, 0, 0}), c = mesh.add_vertex({0, 1, 0});
    EXPECT_THROW(mesh.add_face(a, b, VertexId{3}, 0, 1), Error);
    const FaceId f = mesh.add_face(a, b, c, 0, 1);
    mesh.remove_face(f);
    EXPECT_THROW(mesh.remove_face(f), Error);
    EXPECT_THROW(mesh.remove_face(FaceId{7}), Error);
    mesh.remove_vertex(c);
    EXPECT_THROW(mesh.add_face(a, b, c, 0, 1), Error);
    EXPECT_EQ(mesh.face_count(), 0u);
}

TEST(Mesh, move_star_gives_all_faces_to_the_other_vertex) {
    Mesh mesh = test::octahedron();
    const VertexId copy = mesh.add_vertex(mesh.position(VertexId{1}));
    const auto before = star_of(mesh, VertexId{1});
    mesh.move_star(VertexId{1}, copy);
    EXPECT_EQ(star_of(mesh, copy), before);
    EXPECT_FALSE(mesh.is_alive(VertexId{1}));
    EXPECT_EQ(test::surface_digest(mesh), test::surface_digest(test::octahedron()));
    expect_stars_of_faces(mesh);
}

TEST(Mesh, move_star_joins_stars_as_a_collapse_does) {
    Mesh mesh = test::edge_in_sheet();
    mesh.remove_face(FaceId{0});
    mesh.remove_face(FaceId{1});
    mesh.move_star(VertexId{0}, VertexId{1});
    EXPECT_EQ(star_of(mesh, VertexId{1}).size(), 8u);
    expect_stars_of_faces(mesh);
}

TEST(Mesh, move_star_of_an_unused_vertex_only_removes_it) {
    Mesh mesh = test::octahedron();
    const VertexId lone = mesh.add_vertex({9, 9, 9});
    mesh.move_star(lone, VertexId{0});
    EXPECT_EQ(star_of(mesh, VertexId{0}).size(), 4u);
    EXPECT_EQ(mesh.vertex_count(), 6u);
}

TEST(Mesh, sort_spatially_keeps_the_surface_and_names_the_new_ids) {
    Mesh mesh = grain_mesh();
    for (std::uint32_t f = 0; f < mesh.face_end(); f += 5) mesh.remove_face(FaceId{f});
    std::vector<VertexId> unused;
    test::for_vertices(mesh, [&](VertexId v) {
        if (mesh[v].star == kNoCorner) unused.push_back(v);
    });
    for (VertexId v : unused) mesh.remove_vertex(v);
    mesh[VertexId{0}].is_fixed = true;
    std::vector<Vec3> positions;
    for (std::uint32_t v = 0; v < mesh.vertex_end(); ++v) positions.push_back(mesh.position(VertexId{v}));
    std::vector<bool> were_alive;
    for (std::uint32_t v = 0; v < mesh.vertex_end(); ++v) were_alive.push_back(mesh.is_alive(VertexId{v}));
    const std::uint64_t before = test::surface_digest(mesh);

    const std::vector<VertexId> renumbered = mesh.sort_spatially();
    EXPECT_EQ(test::surface_digest(mesh), before);
    EXPECT_EQ(mesh.face_end(), mesh.face_count());
    EXPECT_EQ(mesh.vertex_end(), mesh.vertex_count());
    for (std::uint32_t v = 0; v < positions.size(); ++v) {
        ASSERT_EQ(renumbered[v] != kNoVertex, were_alive[v]);
        if (!were_alive[v]) continue;
        EXPECT_EQ(mesh.position(renumbered[v]), positions[v]);
    }
    EXPECT_TRUE(mesh[renumbered[0]].is_fixed);
    expect_stars_of_faces(mesh);
}

TEST(Mesh, sort_spatially_puts_near_vertices_near_in_memory) {
    Mesh mesh = test::run(test::noise_volume({12, 12, 12}, 3, 1)).mesh;
    mesh.sort_spatially();
    double sum = 0;
    for (std::uint32_t v = 1; v < mesh.vertex_end(); ++v)
        sum += length(mesh.position(VertexId{v}) - mesh.position(VertexId{v - 1}));
    EXPECT_LT(sum / mesh.vertex_end(), 1.0);
}

TEST(Mesh, sort_spatially_does_not_depend_on_the_order_before) {
    Mesh mesh = grain_mesh();
    mesh.sort_spatially();
    const std::uint64_t once = test::digest(mesh);
    mesh.sort_spatially();
    EXPECT_EQ(test::digest(mesh), once);
}

/// A wavy sheet whose vertices come in an order that is not spatial.
Mesh scattered_sheet(std::uint32_t side) {
    constexpr std::uint32_t kStep = 7919;  // a prime
    const std::uint32_t count = side * side;
    Mesh mesh;
    std::vector<VertexId> ids(count);
    for (std::uint32_t n = 0, at = 0; n < count; ++n, at = (at + kStep) % count) {
        const double x = at % side, y = at / side;
        ids[at] = mesh.add_vertex({x, y, std::sin(x + y)});
    }
    for (std::uint32_t at = 0; at + side < count; ++at) {
        if (at % side + 1 == side) continue;
        mesh.add_face(ids[at], ids[at + 1], ids[at + side], 1, 2);
        mesh.add_face(ids[at + 1], ids[at + side + 1], ids[at + side], 1, 2);
    }
    return mesh;
}

TEST(Mesh, sort_spatially_gives_the_same_mesh_on_several_threads) {
    constexpr std::uint32_t kSide = 140;
    static_assert(kSide * kSide > 1u << 14, "several tasks");
    Mesh once = scattered_sheet(kSide);
    const std::vector<VertexId> renumbered = once.sort_spatially(1);
    for (const std::uint32_t threads : {2u, 3u}) {
        Mesh mesh = scattered_sheet(kSide);
        EXPECT_EQ(mesh.sort_spatially(threads), renumbered);
        EXPECT_EQ(test::digest(mesh), test::digest(once));
    }
}

TEST(Mesh, compact_faces_keeps_order_and_surface) {
    Mesh mesh = grain_mesh();
    for (std::uint32_t f = 0; f < mesh.face_end(); f += 2) mesh.remove_face(FaceId{f});
    std::vector<std::array<VertexId, 3>> expected, found;
    test::for_faces(mesh, [&](FaceId f) { expected.push_back(mesh[f].vertices); });
    mesh.compact_faces();
    EXPECT_EQ(mesh.face_end(), mesh.face_count());
    test::for_faces(mesh, [&](FaceId f) { found.push_back(mesh[f].vertices); });
    EXPECT_EQ(found, expected);
    expect_stars_of_faces(mesh);
    mesh.add_face(VertexId{0}, VertexId{1}, VertexId{2}, 0, 1);
    expect_stars_of_faces(mesh);
}

TEST(Mesh, compact_keeps_order_and_surface) {
    Mesh mesh = grain_mesh();
    for (std::uint32_t f = 0; f < mesh.face_end(); f += 2) mesh.remove_face(FaceId{f});
    for (std::uint32_t v = 0; v < mesh.vertex_end(); ++v)
        if (mesh[VertexId{v}].star == kNoCorner) mesh.remove_vertex(VertexId{v});
    ASSERT_LT(mesh.vertex_count(), mesh.vertex_end());
    std::vector<Vec3> expected_places, places;
    std::vector<std::array<Vec3, 3>> expected, found;
    test::for_vertices(mesh, [&](VertexId v) { expected_places.push_back(mesh.position(v)); });
    test::for_faces(mesh, [&](FaceId f) { expected.push_back(mesh.corners(f)); });
    mesh.compact();
    EXPECT_EQ(mesh.vertex_end(), mesh.vertex_count());
    EXPECT_EQ(mesh.face_end(), mesh.face_count());
    test::for_vertices(mesh, [&](VertexId v) { places.push_back(mesh.position(v)); });
    test::for_faces(mesh, [&](FaceId f) { found.push_back(mesh.corners(f)); });
    EXPECT_EQ(places, expected_places);
    EXPECT_EQ(found, expected);
    expect_stars_of_faces(mesh);
    const VertexId next{mesh.vertex_end()};
    EXPECT_EQ(mesh.add_vertex({}), next) << "no free place is left";
}

TEST(Mesh, flip_faces_turns_every_face_and_nothing_else) {
    Mesh mesh = grain_mesh();
    const std::uint64_t before = test::surface_digest(mesh);
    std::vector<Vec3> normals;
    const auto normal = [&](FaceId f) {
        const auto p = mesh.corners(f);
        return cross(p[1] - p[0], p[2] - p[0]);
    };
    test::for_faces(mesh, [&](FaceId f) { normals.push_back(normal(f)); });
    mesh.flip_faces();
    expect_stars_of_faces(mesh);
    for (std::uint32_t f = 0; f < normals.size(); ++f) EXPECT_EQ(normal(FaceId{f}), -normals[f]);
    EXPECT_NE(test::surface_digest(mesh), before);
    mesh.flip_faces();
    EXPECT_EQ(test::surface_digest(mesh), before);
}

TEST(Mesh, random_changes_leave_consistent_stars) {
    Mesh mesh = grain_mesh();
    std::uint64_t state = 12;
    SCOPED_TRACE("seed 12");
    const auto below = [&](std::uint32_t end) { return static_cast<std::uint32_t>((state = mix64(state)) % end); };
    for (int n = 0; n < 5000; ++n) {
        const FaceId f{below(mesh.face_end())};
        if (mesh.is_alive(f))
            mesh.remove_face(f);
        else
            mesh.add_face(VertexId{n % 50u}, VertexId{50 + n % 31u}, VertexId{100 + n % 17u}, below(4), 4 + below(4));
    }
    expect_stars_of_faces(mesh);
}

}  // namespace
}  // namespace regionmesh
