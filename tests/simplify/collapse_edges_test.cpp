#include "simplify/collapse_edges.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "base/triangle.h"
#include "support/digest.h"
#include "support/runs.h"
#include "support/shapes.h"
#include "support/strata_list.h"

namespace regionmesh {
namespace {

using test::run;

std::uint64_t count(const CollapseResult& result, Verdict verdict) {
    return result.verdicts[static_cast<int>(verdict)];
}

Mesh noise() { return run(test::noise_volume({8, 8, 8}, 3, 5)).mesh; }
Mesh grains() { return run(test::grain_volume({12, 12, 12}, 8, 5)).mesh; }

/// The sheet with only its middle edge free.
Mesh sheet_with_fixed_rim() {
    Mesh mesh = test::edge_in_sheet();
    for (std::uint32_t v = 2; v < mesh.vertex_end(); ++v) mesh[VertexId{v}].is_fixed = true;
    return mesh;
}

double volume_of(const Mesh& mesh, Label label) {
    double volume = 0;
    for (const RegionReport& region : check(mesh).regions)
        if (region.label == label) volume = region.volume;
    return volume;
}

TEST(CollapseEdges, a_box_of_one_label_goes_down_to_twelve_faces) {
    Mesh mesh = run(test::solid_volume({7, 6, 5})).mesh;
    const CollapseResult done = collapse_edges(mesh, {});
    EXPECT_EQ(mesh.face_count(), 12u);
    EXPECT_EQ(mesh.vertex_count(), 8u);
    EXPECT_EQ(done.stopped, StopReason::kTopology);
    EXPECT_EQ(volume_of(mesh, 0), 6 * 5 * 4);
    test::expect_sound(check(mesh));
}

TEST(CollapseEdges, does_nothing_at_the_target) {
    Mesh mesh = noise();
    const std::uint64_t before = test::digest(mesh);
    EXPECT_EQ(collapse_edges(mesh, {.target_faces = mesh.face_count()}).stopped, StopReason::kTarget);
    EXPECT_EQ(test::digest(mesh), before);
}

TEST(CollapseEdges, stops_at_the_target) {
    Mesh mesh = grains();
    const std::uint32_t target = mesh.face_count() / 3;
    EXPECT_EQ(collapse_edges(mesh, {.target_faces = target}).stopped, StopReason::kTarget);
    EXPECT_LE(mesh.face_count(), target);
    EXPECT_GE(mesh.face_count(), target - 6) << "one collapse takes a few faces";
}

TEST(CollapseEdges, a_large_mesh_is_simplified_in_stripes_alike_on_any_number_of_threads) {
    for (const PlacementKind placement : {PlacementKind::kQuadric, PlacementKind::kLindstromTurk}) {
        std::set<std::uint64_t> digests;
        for (const std::uint32_t threads : {1u, 2u, 5u}) {
            Mesh mesh = run(test::grain_volume({24, 24, 24}, 9, 5)).mesh;
            mesh.sort_spatially();
            const test::StrataList strata = test::list_strata(mesh);
            const std::uint32_t target = mesh.face_count() / 3;
            const SimplifyOptions options{.target_faces = target, .placement = placement};
            collapse_edges(mesh, options, {.threads = threads, .is_large = true});
            EXPECT_LE(mesh.face_count(), target);
            EXPECT_GE(mesh.face_count(), target - 6);
            test::expect_same_strata(test::list_strata(mesh), strata);
            test::expect_sound(check(mesh));
            digests.insert(test::digest(mesh));
        }
        EXPECT_EQ(digests.size(), 1u);
    }
}

TEST(CollapseEdges, one_free_edge_is_collapsed_once) {
    Mesh mesh = sheet_with_fixed_rim();
    const CollapseResult done = collapse_edges(mesh, {});
    EXPECT_EQ(count(done, Verdict::kAccepted), 1u);
    EXPECT_EQ(done.verdicts, (VerdictCounts{1}));
    EXPECT_EQ(mesh.face_count(), 8u);
}

TEST(CollapseEdges, counts_a_link_verdict) {
    Mesh mesh = test::shape(test::kTetrahedronCorners, test::tetrahedron_faces());
    const CollapseResult done = collapse_edges(mesh, {});
    EXPECT_EQ(done.verdicts, (VerdictCounts{0, 0, 6}));
    EXPECT_EQ(done.stopped, StopReason::kTopology);
    EXPECT_EQ(mesh.face_count(), 4u);
}

TEST(CollapseEdges, counts_edges_that_strata_forbid) {
    Mesh mesh = run(test::solid_volume({2, 2, 2})).mesh;
    const CollapseResult done = collapse_edges(mesh, {});
    EXPECT_EQ(done.verdicts, (VerdictCounts{0, 18})) << "twelve edges and six diagonals between eight points";
}

TEST(CollapseEdges, counts_a_quality_verdict) {
    Mesh mesh = sheet_with_fixed_rim();
    const Vec3 narrow[] = {{0.5, 0.4, 0}, {0.5, -0.4, 0}, {0, 0.9, 0}, {-0.7, 0, 0},
                           {0, -0.9, 0},  {1, 0.9, 0},    {1.7, 0, 0}, {1, -0.9, 0}};
    for (std::uint32_t v = 0; v < std::size(narrow); ++v) mesh[VertexId{v + 2}].position = narrow[v];
    const CollapseResult done = collapse_edges(mesh, {.promises = {.min_quality = 0.2}});
    EXPECT_EQ(done.verdicts, (VerdictCounts{0, 0, 0, 0, 1}))
        << "at its best place; folded at the end that stays, so no second choice";
}

/// The sheet as a pyramid frustum: its middle edge lies at this height, and would go up to the tip.
Mesh frustum(double height) {
    Mesh mesh = sheet_with_fixed_rim();
    for (std::uint32_t v : {0u, 1u}) mesh[VertexId{v}].position.z = height;
    return mesh;
}

TEST(CollapseEdges, counts_an_intersect_verdict) {
    Mesh free = frustum(0.5);
    EXPECT_EQ(collapse_edges(free, {.promises = {.min_quality = 0}}).verdicts, (VerdictCounts{1}));
    const Vec3 tip = free.position(VertexId{free.is_alive(VertexId{0}) ? 0u : 1u});
    // A thin face where the tip would be.
    Mesh mesh = frustum(0.5);
    test::add_shape(mesh, {tip + Vec3{0, 0, -0.01}, tip + Vec3{0.01, 0, 0.1}, tip + Vec3{-0.01, 0.01, 0.1}},
                    {{{0, 1, 2}, 1, 2}});
    for (std::uint32_t v = 10; v < 13; ++v) mesh[VertexId{v}].is_fixed = true;
    Mesh unchecked = frustum(0.5);
    test::add_shape(unchecked, {tip + Vec3{0, 0, -0.01}, tip + Vec3{0.01, 0, 0.1}, tip + Vec3{-0.01, 0.01, 0.1}},
                    {{{0, 1, 2}, 1, 2}});
    for (std::uint32_t v = 10; v < 13; ++v) unchecked[VertexId{v}].is_fixed = true;
    VerdictCounts crossing{};
    crossing[static_cast<int>(Verdict::kIntersect)] = 1;
    EXPECT_EQ(collapse_edges(mesh, {.promises = {.min_quality = 0}}).verdicts, crossing);
    EXPECT_EQ(collapse_edges(unchecked, {.promises = {.min_quality = 0, .intersect_check = false}}).verdicts,
              (VerdictCounts{1}));
}

TEST(CollapseEdges, noise_meets_every_verdict) {
    Mesh mesh = noise();
    const CollapseResult done =
        collapse_edges(mesh, {.promises = {.max_error = 1, .samples = Lattice{.size = {8, 8, 8}}}});
    // All but those of promises that are not asked for here.
    for (int n = 0; n <= static_cast<int>(Verdict::kIntersect); ++n)
        EXPECT_GT(done.verdicts[n], 0u) << kVerdictNames[n];
}

TEST(CollapseEdges, fixed_vertices_stay) {
    Mesh mesh = grains();
    mesh.sort_spatially();
    std::map<std::uint32_t, Vec3> fixed;
    for (std::uint32_t v = 0; v < mesh.vertex_end(); v += 7) {
        mesh[VertexId{v}].is_fixed = true;
        fixed[v] = mesh.position(VertexId{v});
    }
    collapse_edges(mesh, {.target_faces = mesh.face_count() / 2});
    for (const auto& [v, position] : fixed) {
        EXPECT_TRUE(mesh.is_alive(VertexId{v}));
        EXPECT_EQ(mesh.position(VertexId{v}), position);
    }
    test::expect_sound(check(mesh));
}

TEST(CollapseEdges, faces_that_reach_beyond_the_limits_stay) {
    Mesh mesh = run(test::ball_volume({14, 14, 14}, 5)).mesh;
    CollapseBounds bounds;
    bounds.limits.high = {7.3, 9.1, HUGE_VAL};
    const auto faces_beyond = [&] {
        std::set<std::array<double, 9>> faces;
        test::for_faces(mesh, [&](FaceId f) {
            std::array<double, 9> place;
            bool reaches_out = false;
            for (int n = 0; n < 3; ++n) {
                const Vec3 p = mesh.corners(f)[n];
                reaches_out |= p.x > 7.3 || p.y > 9.1;
                for (int axis = 0; axis < 3; ++axis) place[3 * n + axis] = p[axis];
            }
            if (reaches_out) faces.insert(place);
        });
        return faces;
    };
    const auto before = faces_beyond();
    const std::uint32_t count_before = mesh.face_count();
    collapse_edges(mesh, {}, bounds);
    EXPECT_EQ(faces_beyond(), before);
    EXPECT_LT(mesh.face_count(), count_before * 0.8);
    test::for_vertices(mesh, [&](VertexId v) { EXPECT_FALSE(mesh[v].is_fixed); });
    test::expect_sound(check(mesh));
}

TEST(CollapseEdges, logs_all_collapses_and_changes_nothing_by_that) {
    Mesh silent = grains(), logged = grains();
    const std::uint32_t held = logged.face_count();
    CollapseLog log;
    const CollapseResult done = collapse_edges(logged, {.max_cost = 0.1}, {.log = &log});
    collapse_edges(silent, {.max_cost = 0.1});
    EXPECT_EQ(test::digest(silent), test::digest(logged));
    EXPECT_EQ(log.collapses.size(), count(done, Verdict::kAccepted));
    EXPECT_EQ(log.collapses.front().level, 0) << "of the prepass";
    EXPECT_GT(log.collapses.back().level, 1e-3);
    EXPECT_TRUE(std::ranges::is_sorted(log.collapses, {}, &LoggedCollapse::level));
    std::uint32_t removed = 0;
    for (const LoggedCollapse& collapse : log.collapses) removed += collapse.faces;
    EXPECT_EQ(held - removed, logged.face_count());
}

TEST(CollapseEdges, merged_vertices_stay_within_the_limits) {
    Mesh mesh = run(test::grain_volume({10, 10, 10}, 5, 3)).mesh;
    std::set<std::array<double, 3>> before;
    const auto key = [&](VertexId v) { return std::array{mesh.position(v).x, mesh.position(v).y, mesh.position(v).z}; };
    test::for_vertices(mesh, [&](VertexId v) { before.insert(key(v)); });
    CollapseBounds bounds;
    bounds.limits.high.z = 4;
    collapse_edges(mesh, {}, bounds);
    std::uint32_t beyond = 0;
    test::for_vertices(mesh, [&](VertexId v) {
        if (mesh.position(v).z < 4 || (mesh[v].sides & 0x30)) return;
        ++beyond;
        EXPECT_TRUE(before.contains(key(v)));
    });
    EXPECT_GT(beyond, 0u);
    test::expect_sound(check(mesh));
}

TEST(CollapseEdges, at_cost_level_zero_only_flat_parts_go) {
    Mesh mesh =
        run(test::TextVolume({{"1111", "1111", "1111"}, {"1111", "1221", "1111"}, {"1111", "1111", "1111"}})).mesh;
    const CheckReport before = check(mesh);
    const std::uint32_t faces = mesh.face_count();
    collapse_edges(mesh, {.max_cost = 1e-12});
    const CheckReport after = check(mesh);
    EXPECT_LT(mesh.face_count(), faces);
    for (std::size_t n = 0; n < before.regions.size(); ++n)
        EXPECT_NEAR(after.regions[n].volume, before.regions[n].volume, 1e-5);
}

TEST(CollapseEdges, a_higher_cost_level_or_error_leaves_fewer_faces) {
    std::uint32_t last = ~0u;
    for (double cost : {1e-9, 1e-3, 1e-1}) {
        Mesh mesh = grains();
        collapse_edges(mesh, {.max_cost = cost});
        EXPECT_LT(mesh.face_count(), last);
        last = mesh.face_count();
    }
    last = ~0u;
    for (double error : {1e-6, 0.05, 0.3}) {
        Mesh mesh = grains();
        EXPECT_EQ(collapse_edges(mesh, {.promises = {.max_error = error}}).stopped, StopReason::kMaxError);
        EXPECT_LT(mesh.face_count(), last);
        last = mesh.face_count();
    }
}

TEST(CollapseEdges, a_large_mesh_gives_up_its_cheap_edges_first_on_any_number_of_threads) {
    std::set<std::uint64_t> digests;
    std::map<bool, double> volume;
    for (const auto& [is_large, threads] : {std::pair{false, 1u}, {true, 1u}, {true, 3u}}) {
        Mesh mesh = run(test::ball_volume({40, 40, 40}, 15)).mesh;
        mesh.sort_spatially();
        const std::uint32_t target = mesh.face_count() / 10;
        const CollapseResult done =
            collapse_edges(mesh, {.target_faces = target}, {.threads = threads, .is_large = is_large});
        EXPECT_EQ(done.stopped, StopReason::kTarget);
        EXPECT_LE(mesh.face_count(), target);
        EXPECT_GT(mesh.face_count() + 4, target);
        test::expect_sound(check(mesh));
        volume[is_large] = volume_of(mesh, 1);
        if (is_large) digests.insert(test::digest(mesh));
    }
    EXPECT_EQ(digests.size(), 1u);
    EXPECT_NEAR(volume[true], volume[false], 0.005 * volume[false]);
}

TEST(CollapseEdges, a_large_mesh_goes_down_to_what_topology_allows) {
    Mesh mesh = run(test::solid_volume({7, 6, 5})).mesh;
    const CollapseResult done = collapse_edges(mesh, {}, {.is_large = true});
    EXPECT_EQ(mesh.face_count(), 12u);
    EXPECT_EQ(done.stopped, StopReason::kTopology);
    EXPECT_GT(done.bytes, 0u);
}

TEST(CollapseEdges, an_error_that_bounds_nothing_is_not_why_it_stopped) {
    Mesh mesh = grains();
    EXPECT_EQ(collapse_edges(mesh, {.promises = {.max_error = 1e9}}).stopped, StopReason::kTopology);
}

TEST(CollapseEdges, a_small_error_keeps_a_ball_round) {
    Mesh mesh = run(test::ball_volume({20, 20, 20}, 7)).mesh;
    const double before = volume_of(mesh, 1);
    const std::uint32_t faces = mesh.face_count();
    collapse_edges(mesh, {.promises = {.max_error = 0.2}});
    EXPECT_LT(mesh.face_count(), faces / 2);
    EXPECT_NEAR(volume_of(mesh, 1), before, 0.03 * before);
    test::for_faces(mesh, [&](FaceId f) {
        if (is_exterior(mesh[f].labels[1])) return;
        for (Vec3 p : mesh.corners(f)) EXPECT_NEAR(length(p - Vec3{9.5, 9.5, 9.5}), 7, 1.5);
    });
}

TEST(CollapseEdges, a_ball_that_outgrows_its_first_box_meets_no_face_that_is_not_there) {
    Mesh mesh = run(test::ball_volume({10, 10, 10}, 4.325), {.decimate = false}).mesh;
    mesh.sort_spatially();
    collapse_edges(mesh, {.promises = {.min_quality = 0}, .perturbation = 0.9});
    test::expect_sound(check(mesh));
}

TEST(CollapseEdges, the_same_run_twice_gives_the_same_bytes) {
    for (double perturbation : {0.0, 1e-7, 1e-2}) {
        Mesh first = noise(), second = noise();
        collapse_edges(first, {.target_faces = 2000, .perturbation = perturbation});
        collapse_edges(second, {.target_faces = 2000, .perturbation = perturbation});
        EXPECT_EQ(test::digest(first), test::digest(second));
    }
}

TEST(CollapseEdges, keeps_every_face_above_the_quality_floor) {
    for (double floor : {0.0, 0.05, 0.1, 0.13}) {
        Mesh mesh = noise();
        collapse_edges(mesh, {.promises = {.min_quality = floor}});
        EXPECT_GE(check(mesh).quality.min, floor);
        test::expect_sound(check(mesh));
    }
}

TEST(CollapseEdges, vertices_on_box_sides_keep_that_coordinate_to_the_bit) {
    Mesh mesh = run(test::noise_volume({6, 7, 8}, 3, 9).spaced({0.1, 0.7, 1.0 / 3})).mesh;
    const Vec3 high{5 * 0.1, 6 * 0.7, 7 * (1.0 / 3)};
    collapse_edges(mesh, {.promises = {.scale = 0.3}});
    test::for_vertices(mesh, [&](VertexId v) {
        for (int side = 0; side < 6; ++side) {
            if (!(mesh[v].sides >> side & 1)) continue;
            EXPECT_EQ(mesh.position(v)[side / 2], side % 2 ? high[side / 2] : 0.0);
        }
    });
}

TEST(CollapseEdges, reports_progress) {
    Mesh mesh = grains();
    int calls = 0;
    SimplifyOptions options;
    options.on_progress = [&](std::uint64_t) { ++calls; };
    const std::uint32_t before = mesh.face_count();
    collapse_edges(mesh, options);
    EXPECT_GT(calls, 0);
    EXPECT_LT(static_cast<std::uint32_t>(calls), before / 10) << "now and then";
}

}  // namespace
}  // namespace regionmesh
