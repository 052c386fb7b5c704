#include "regionmesh/smooth.h"

#include <gtest/gtest.h>

#include <bit>
#include <map>

#include "mesh/strata.h"
#include "regionmesh/simplify.h"
#include "smooth/filters/relax.h"
#include "support/digest.h"
#include "support/runs.h"
#include "support/shapes.h"
#include "support/strata_list.h"
#include "support/surface_windows.h"

namespace regionmesh {
namespace {

using test::kVertexFilters;
using test::run;

Mesh grains() { return run(test::grain_volume({12, 12, 12}, 8, 5)).mesh; }
Mesh noise(std::uint32_t labels = 4) { return run(test::noise_volume({7, 7, 7}, labels, 5)).mesh; }
Mesh ball() { return run(test::ball_volume({16, 16, 16}, 5.5)).mesh; }

double volume_of(const Mesh& mesh, Label label) {
    for (const RegionReport& region : check(mesh).regions)
        if (region.label == label) return region.volume;
    return 0;
}

TEST(Smooth, no_passes_change_nothing) {
    Mesh mesh = noise();
    const std::uint64_t before = test::digest(mesh);
    EXPECT_EQ(smooth(mesh, {.passes = 0}).vertices, 0u);
    EXPECT_EQ(test::digest(mesh), before);
}

TEST(Smooth, takes_a_model_without_faces) {
    Mesh mesh;
    EXPECT_EQ(smooth(mesh, {}).vertices, 0u);
    mesh.add_vertex({1, 2, 3});
    for (SmoothFilter filter : kVertexFilters) EXPECT_EQ(smooth(mesh, {.filter = filter}).vertices, 1u);
    EXPECT_EQ(mesh.position(VertexId{0}), (Vec3{1, 2, 3}));
}

TEST(Smooth, makes_the_passes_of_the_equation) {
    for (SmoothFilter filter : {SmoothFilter::kTaubin, SmoothFilter::kLaplacian})
        for (std::uint32_t passes : {1u, 2u, 7u}) {
            Mesh mesh = ball();
            const test::Surface surface(mesh);
            const SmoothOptions options{
                .filter = filter, .passes = passes, .lambda = 0.4, .min_quality = 0, .intersect_check = false};
            SlidingArray<Vec3> places[2];
            for (auto& p : places)
                for (std::uint32_t v = 0; v < mesh.vertex_end(); ++v) p.push_back(mesh.position(VertexId{v}));
            for (std::uint32_t pass = 0; pass < passes; ++pass)
                relax(surface.window, surface.neighbours, surface.window.vertices_of(0), relax_factor(options, pass),
                      places[pass % 2], places[1 - pass % 2], 1);
            const SmoothReport report = smooth(mesh, options);
            EXPECT_EQ(report.backtracked, 0u);
            EXPECT_EQ(report.vertex_passes, std::uint64_t{passes} * mesh.vertex_count());
            test::for_vertices(mesh, [&](VertexId v) { EXPECT_EQ(mesh.position(v), places[passes % 2][index(v)]); });
        }
}

TEST(Smooth, taubin_keeps_the_volume_of_a_ball_and_laplacian_shrinks_it) {
    Mesh first = ball(), second = ball();
    const double before = volume_of(first, 1);
    smooth(first, {});
    smooth(second, {.filter = SmoothFilter::kLaplacian});
    EXPECT_NEAR(volume_of(first, 1), before, 0.02 * before);
    EXPECT_LT(volume_of(second, 1), 0.9 * before);
}

TEST(Smooth, shells_of_hardly_any_volume_are_smoothed) {
    Mesh mesh = ball();
    test::for_vertices(mesh, [&](VertexId v) { mesh[v].position.y *= 1e-200; });
    const SmoothReport report = smooth(mesh, {.filter = SmoothFilter::kTaubin, .passes = 5});
    EXPECT_EQ(report.vertices, mesh.vertex_count());
    EXPECT_GT(report.largest_displacement, 0.05);
}

TEST(Smooth, moves_vertices_and_nothing_else) {
    for (SmoothFilter filter : kVertexFilters) {
        const Mesh before = noise();
        Mesh mesh = test::copy_of(before);
        smooth(mesh, {.filter = filter});
        ASSERT_EQ(mesh.face_end(), before.face_end());
        test::for_faces(mesh, [&](FaceId f) {
            EXPECT_EQ(mesh[f].vertices, before[f].vertices);
            EXPECT_EQ(mesh[f].labels, before[f].labels);
        });
        test::expect_same_strata(test::list_strata(mesh), test::list_strata(before));
        test::expect_generic(mesh);
        test::expect_sound(check(mesh));
    }
}

TEST(Smooth, a_model_with_free_places_keeps_its_ids) {
    Mesh mesh = grains();
    simplify(mesh, {.target_faces = mesh.face_count() / 4});
    Mesh same;
    std::vector<VertexId> ids(mesh.vertex_end());
    test::for_vertices(mesh, [&](VertexId v) { ids[index(v)] = same.add_vertex(mesh.position(v), mesh[v].sides); });
    test::for_faces(mesh, [&](FaceId f) {
        const auto& v = mesh[f].vertices;
        same.add_face(ids[index(v[0])], ids[index(v[1])], ids[index(v[2])], mesh[f].labels[0], mesh[f].labels[1]);
    });
    ASSERT_LT(same.vertex_end(), mesh.vertex_end());
    smooth(mesh, {});
    smooth(same, {});
    test::for_vertices(mesh, [&](VertexId v) { EXPECT_EQ(mesh.position(v), same.position(ids[index(v)])); });
    test::expect_sound(check(mesh));
}

TEST(Smooth, keeps_the_sampled_box_to_the_bit) {
    const Vec3 high{5 * 0.1, 6 * 0.7, 7 * (1.0 / 3)};
    for (SmoothFilter filter : kVertexFilters) {
        Mesh mesh = run(test::noise_volume({6, 7, 8}, 3, 9).spaced({0.1, 0.7, 1.0 / 3})).mesh;
        int edges = 0, corners = 0;
        smooth(mesh, {.filter = filter, .scale = 0.3});
        test::for_vertices(mesh, [&](VertexId v) {
            const int sides = std::popcount(mesh[v].sides);
            for (int side = 0; side < 6; ++side) {
                if (!(mesh[v].sides >> side & 1)) continue;
                EXPECT_EQ(mesh.position(v)[side / 2], side % 2 ? high[side / 2] : 0.0);
            }
            edges += sides == 2;
            corners += sides == 3;
        });
        EXPECT_EQ(corners, 8);
        EXPECT_GT(edges, 20) << "vertices on two sides lie on an edge of the box, straight";
        test::expect_sound(check(mesh));
    }
}

TEST(Smooth, quadruple_points_stay_unless_they_may_move) {
    for (bool may : {false, true}) {
        const Mesh before = noise();
        Mesh mesh = test::copy_of(before);
        smooth(mesh, {.move_points = may});
        int points = 0, moved = 0;
        test::for_vertices(mesh, [&](VertexId v) {
            if (vertex_labels(mesh, v).size() != 4 || mesh[v].sides != 0) return;
            ++points;
            moved += mesh.position(v) != before.position(v);
        });
        EXPECT_GT(points, 100);
        EXPECT_GE(moved, may ? points / 2 : 0);
        EXPECT_LE(moved, may ? points : 0);
        test::expect_sound(check(mesh));
    }
}

TEST(Smooth, the_rim_of_an_open_surface_stays) {
    ReconstructOptions open = test::plain();
    open.cap = false;
    const Mesh before = run(test::grain_volume({10, 10, 10}, 6, 4), open).mesh;
    for (SmoothFilter filter : kVertexFilters) {
        Mesh mesh = test::copy_of(before);
        smooth(mesh, {.filter = filter});
        CheckOptions options;
        options.boundary_is_open = true;
        test::expect_sound(check(mesh, options));
        test::for_vertices(mesh, [&](VertexId v) {
            for (int side = 0; side < 6; ++side)
                if (mesh[v].sides >> side & 1) {
                    EXPECT_EQ(mesh.position(v)[side / 2], before.position(v)[side / 2]);
                }
        });
    }
}

TEST(Smooth, a_hole_of_a_foreign_surface_keeps_its_rim) {
    Mesh mesh = ball();
    const auto hole = mesh[FaceId{5}].vertices;
    mesh.remove_face(FaceId{5});
    std::array<Vec3, 3> rim;
    for (int n = 0; n < 3; ++n) rim[n] = mesh.position(hole[n]);
    EXPECT_GT(smooth(mesh, {}).largest_displacement, 0);
    for (int n = 0; n < 3; ++n) EXPECT_EQ(mesh.position(hole[n]), rim[n]);
}

TEST(Smooth, the_numbers_of_vertices_and_faces_do_not_matter) {
    const auto expect_same = [](const char* name, const Mesh& mesh, const SmoothOptions& options) {
        SCOPED_TRACE(std::string(name) + ", filter " + std::to_string(static_cast<int>(options.filter)));
        Mesh first = test::copy_of(mesh), second = test::renumbered(mesh, 7);
        ASSERT_EQ(test::surface_digest(first), test::surface_digest(second));
        const SmoothReport one = smooth(first, options), other = smooth(second, options);
        EXPECT_EQ(test::surface_digest(first), test::surface_digest(second));
        EXPECT_EQ(one.backtracked, other.backtracked);
        EXPECT_EQ(one.crossing_pairs, other.crossing_pairs);
    };
    for (const SmoothOptions& options : {SmoothOptions{}, {.filter = SmoothFilter::kLaplacian, .passes = 100}}) {
        expect_same("grains", grains(), options);
        expect_same("noise", noise(), options);
        expect_same("noise of two labels", noise(2), options);
    }
    expect_same("few grains", run(test::grain_volume({8, 8, 8}, 4, 2)).mesh, {.filter = SmoothFilter::kNifpms});
    expect_same("little noise", run(test::noise_volume({5, 5, 5}, 3, 2)).mesh, {.filter = SmoothFilter::kNifpms});
}

TEST(Smooth, threads_do_not_matter) {
    for (SmoothFilter filter : kVertexFilters) {
        const std::uint32_t side = filter == SmoothFilter::kNifpms ? 6 : 12;
        Mesh one = run(test::noise_volume({side, side, side}, 3, 1)).mesh, many = test::copy_of(one);
        const SmoothReport by_one = smooth(one, {.filter = filter, .threads = 1}),
                           by_many = smooth(many, {.filter = filter, .threads = 3});
        EXPECT_EQ(test::digest(one), test::digest(many));
        EXPECT_EQ(by_one.backtracked, by_many.backtracked);
        EXPECT_EQ(by_one.crossing_pairs, by_many.crossing_pairs);
        EXPECT_EQ(by_one.rms_displacement, by_many.rms_displacement);
    }
}

TEST(Smooth, the_unit_of_length_changes_nothing) {
    for (SmoothFilter filter : kVertexFilters) {
        Mesh small = run(test::noise_volume({5, 5, 5}, 3, 1)).mesh,
             large = run(test::noise_volume({5, 5, 5}, 3, 1).spaced({1024, 1024, 1024})).mesh;
        smooth(small, {.filter = filter});
        smooth(large, {.filter = filter, .scale = 1024});
        double most = 0;
        test::for_vertices(
            small, [&](VertexId v) { most = std::max(most, length(1024 * small.position(v) - large.position(v))); });
        EXPECT_LT(most, 1e-6);
    }
}

TEST(SmoothReport, says_what_was_done) {
    const Mesh before = noise();
    Mesh mesh = test::copy_of(before);
    const CheckReport was = check(before);
    const SmoothReport report = smooth(mesh, {});
    const CheckReport is = check(mesh);
    EXPECT_EQ(report.vertices, mesh.vertex_count());
    EXPECT_EQ(report.vertex_passes, 20u * mesh.vertex_count());
    double most = 0, sum = 0;
    test::for_vertices(mesh, [&](VertexId v) {
        const double moved = length2(mesh.position(v) - before.position(v));
        most = std::max(most, std::sqrt(moved));
        sum += moved;
    });
    EXPECT_DOUBLE_EQ(report.largest_displacement, most);
    EXPECT_NEAR(report.rms_displacement, std::sqrt(sum / mesh.vertex_count()), 1e-9);
    EXPECT_GT(report.low_quality_faces, 0u);
    EXPECT_GT(report.backtracked, 0u);
    EXPECT_LT(report.backtracked, report.vertices);
    for (const RegionReport& region : was.regions)
        EXPECT_NEAR(report.volume_before.at(region.label), region.volume, 1e-9);
    for (const RegionReport& region : is.regions)
        EXPECT_NEAR(report.volume_after.at(region.label), region.volume, 1e-9);
}

}  // namespace
}  // namespace regionmesh
