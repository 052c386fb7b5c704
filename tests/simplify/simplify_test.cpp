#include "regionmesh/simplify.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <set>
#include <stdexcept>
#include <vector>

#include "regionmesh/mesh.h"
#include "simplify/tuning.h"
#include "support/digest.h"
#include "support/runs.h"
#include "support/strata_list.h"

namespace regionmesh {
namespace {

using test::run;

/// Enough faces for tiles.
Mesh large() {
    static const Mesh made = run(test::grain_volume({64, 60, 56}, 60, 21)).mesh;
    EXPECT_GT(made.face_count(), 2 * kFewestTiles * kTileFaces) << "this test needs tiles";
    Mesh copy;
    test::for_vertices(made, [&](VertexId v) { copy.add_vertex(made.position(v), made[v].sides); });
    test::for_faces(made, [&](FaceId f) {
        const auto& [a, b, c] = made[f].vertices;
        copy.add_face(a, b, c, made[f].labels[0], made[f].labels[1]);
    });
    return copy;
}
Mesh small() { return run(test::grain_volume({16, 16, 16}, 8, 5)).mesh; }

TEST(Simplify, large_meshes_reach_the_target_in_tiles_and_stay_sound) {
    Mesh mesh = large();
    const std::uint32_t before = mesh.face_count();
    const SimplifyResult done = simplify(mesh, {.target_faces = before / 10});
    EXPECT_GT(done.tile_passes, 0u);
    EXPECT_EQ(done.stopped, StopReason::kTarget);
    EXPECT_LE(mesh.face_count(), before / 10);
    EXPECT_GE(mesh.face_count(), before / 10 - 6) << "one collapse takes a few faces";
    EXPECT_GT(done.bytes, mesh.bytes());
    test::expect_sound(check(mesh));
}

TEST(Simplify, says_how_many_faces_are_left_and_ends_where_that_is_not_wanted) {
    Mesh mesh = large();
    SimplifyOptions told{.target_faces = mesh.face_count() / 10, .threads = 1};
    std::vector<std::uint64_t> left;
    told.on_progress = [&](std::uint64_t faces) { left.push_back(faces); };
    const std::uint32_t before = mesh.face_count();
    simplify(mesh, told);
    EXPECT_GT(left.size(), 10u) << "in tiles, too";
    EXPECT_EQ(left.front(), before);
    EXPECT_TRUE(std::ranges::is_sorted(left, std::greater()));
    EXPECT_GE(left.back(), mesh.face_count());

    mesh = large();
    told.on_progress = [](std::uint64_t) { throw std::runtime_error("enough"); };
    EXPECT_THROW(simplify(mesh, told), std::runtime_error);
}

TEST(Simplify, keeps_all_strata) {
    Mesh mesh = large();
    const test::StrataList strata = test::list_strata(mesh);
    simplify(mesh, {.target_faces = mesh.face_count() / 20});
    test::expect_same_strata(test::list_strata(mesh), strata);
}

TEST(Simplify, small_meshes_need_no_tiles) {
    Mesh mesh = small();
    const SimplifyResult done = simplify(mesh, {.target_faces = mesh.face_count() / 4});
    EXPECT_EQ(done.tile_passes, 0u);
    EXPECT_EQ(done.stopped, StopReason::kTarget);
}

TEST(Determinism, simplify_gives_the_same_bytes_for_any_number_of_threads) {
    for (PlacementKind placement : {PlacementKind::kQuadric, PlacementKind::kLindstromTurk}) {
        std::set<std::uint64_t> digests;
        for (std::uint32_t threads : {1u, 2u, 3u, 8u}) {
            Mesh mesh = large();
            simplify(mesh, {.target_faces = mesh.face_count() / 10, .placement = placement, .threads = threads});
            digests.insert(test::digest(mesh));
        }
        EXPECT_EQ(digests.size(), 1u) << kPlacementNames[static_cast<int>(placement)];
    }
}

TEST(Simplify, does_not_depend_on_the_order_of_vertices_and_faces) {
    Mesh first = large(), second;
    std::vector<VertexId> ids(first.vertex_end());
    for (std::uint32_t v = first.vertex_end(); v-- > 0;)
        ids[v] = second.add_vertex(first.position(VertexId{v}), first[VertexId{v}].sides);
    for (std::uint32_t f = first.face_end(); f-- > 0;) {
        const auto& [a, b, c] = first[FaceId{f}].vertices;
        second.add_face(ids[index(a)], ids[index(b)], ids[index(c)], first[FaceId{f}].labels[0],
                        first[FaceId{f}].labels[1]);
    }
    const std::uint32_t target = first.face_count() / 10;
    simplify(first, {.target_faces = target});
    simplify(second, {.target_faces = target});
    EXPECT_EQ(test::digest(first), test::digest(second));
}

TEST(Simplify, fixed_vertices_stay_and_stay_fixed) {
    Mesh mesh = large();
    std::set<std::array<double, 3>> fixed;
    const auto key = [&](VertexId v) { return std::array{mesh.position(v).x, mesh.position(v).y, mesh.position(v).z}; };
    for (std::uint32_t v = 0; v < mesh.vertex_end(); v += 50) {
        mesh[VertexId{v}].is_fixed = true;
        fixed.insert(key(VertexId{v}));
    }
    EXPECT_GT(simplify(mesh, {.target_faces = mesh.face_count() / 5}).tile_passes, 0u);
    std::set<std::array<double, 3>> left;
    test::for_vertices(mesh, [&](VertexId v) {
        if (mesh[v].is_fixed) left.insert(key(v));
    });
    EXPECT_EQ(left, fixed);
    test::expect_sound(check(mesh));
}

TEST(Simplify, works_at_any_scale) {
    Mesh unit = large(), tiny = large();
    constexpr double kScale = 1.0 / 1024;
    test::for_vertices(tiny, [&](VertexId v) { tiny[v].position = kScale * tiny[v].position; });
    const std::uint32_t target = unit.face_count() / 10;
    simplify(unit, {.target_faces = target});
    const SimplifyResult done = simplify(tiny, {.target_faces = target, .promises = {.scale = kScale}});
    EXPECT_GT(done.tile_passes, 0u);
    EXPECT_EQ(unit.face_count(), tiny.face_count());
    test::expect_sound(check(tiny));
}

TEST(Simplify, stops_at_the_largest_error_or_cost) {
    for (const SimplifyOptions& options :
         {SimplifyOptions{.max_cost = 1e-2}, SimplifyOptions{.promises = {.max_error = 0.1}}}) {
        Mesh mesh = large();
        const std::uint32_t before = mesh.face_count();
        const SimplifyResult done = simplify(mesh, options);
        EXPECT_NE(done.stopped, StopReason::kTarget);
        EXPECT_LT(mesh.face_count(), before / 2);
        EXPECT_GT(mesh.face_count(), before / 20);
    }
}

TEST(Simplify, typical_edge_serves_as_scale) {
    Mesh mesh = large();
    const std::uint32_t target = mesh.face_count() / 10;
    EXPECT_EQ(simplify(mesh, {.target_faces = target, .promises = {.scale = typical_edge(mesh)}}).stopped,
              StopReason::kTarget);
    EXPECT_LE(mesh.face_count(), target);
}

}  // namespace
}  // namespace regionmesh
