#include "regionmesh/improve.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "regionmesh/simplify.h"
#include "support/digest.h"
#include "support/runs.h"
#include "support/strata_list.h"

namespace regionmesh {
namespace {

using test::run;

/// The quality after is nowhere worse than before, and better on the whole.
void expect_better(const ImproveResult& done) {
    EXPECT_GE(done.after.min_quality, done.before.min_quality);
    EXPECT_GT(done.after.mean_quality, done.before.mean_quality);
    EXPECT_LE(done.after.faces_below, done.before.faces_below);
    EXPECT_GT(done.flips + done.moves, 0u);
}

ReconstructOptions improved(double share) {
    ReconstructOptions options{.improve = true, .background = {}};
    if (share > 0) options.reduce = share;
    return options;
}

TEST(Improve, keeps_flat_sheets_flat_and_makes_them_better) {
    test::ArrayVolume volume = test::solid_volume({12, 10, 9});
    Mesh mesh = run(volume).mesh;
    simplify(mesh, {.target_faces = mesh.face_count() / 3});
    expect_better(improve(mesh, {}));
    test::expect_sound(check(mesh));
    test::for_faces(mesh, [&](FaceId f) {
        const auto p = mesh.corners(f);
        bool is_flat = false;
        for (int axis = 0; axis < 3; ++axis)
            for (double level : {0.0, axis == 0 ? 11.0 : axis == 1 ? 9.0 : 8.0})
                is_flat |= p[0][axis] == level && p[1][axis] == level && p[2][axis] == level;
        EXPECT_TRUE(is_flat) << "every face lies in a side of the box, to the last bit";
    });
}

TEST(Improve, keeps_every_sample_and_adds_no_violation) {
    test::ArrayVolume volumes[] = {test::noise_volume({9, 8, 10}, 3, 1), test::grain_volume({20, 18, 22}, 9, 3),
                                   test::ball_volume({16, 16, 16}, 5.3)};
    for (test::ArrayVolume& volume : volumes)
        for (const Vec3 spacing : {Vec3{1, 1, 1}, Vec3{0.4, 0.4, 0.12}, Vec3{0.7, 1.3, 4}})
            for (const double share : {0.0, 0.5, 0.9})
                for (const SmoothFilter filter : {SmoothFilter::kLattice, SmoothFilter::kTaubin}) {
                    volume.lattice().spacing = spacing;
                    ReconstructOptions options = improved(share);
                    options.smooth.filter = filter;
                    const Reconstruction made = run(volume, options);
                    test::expect_sound(made.report.check);
                    EXPECT_EQ(made.report.samples.value().wrong, 0u);
                    const ImproveResult& done = made.report.improved.value();
                    EXPECT_GE(done.after.min_quality, done.before.min_quality);
                    EXPECT_LE(done.after.faces_below, done.before.faces_below);
                    EXPECT_DOUBLE_EQ(done.after.min_quality, made.report.check.quality.min);
                }
}

TEST(Improve, keeps_all_strata) {
    Mesh mesh = run(test::grain_volume({20, 18, 22}, 9, 3)).mesh;
    simplify(mesh, {.target_faces = mesh.face_count() / 5});
    const test::StrataList strata = test::list_strata(mesh);
    expect_better(improve(mesh, {}));
    test::expect_same_strata(test::list_strata(mesh), strata);
}

TEST(Improve, leaves_fixed_vertices_and_their_faces) {
    Mesh mesh = run(test::ball_volume({16, 16, 16}, 5.3)).mesh;
    simplify(mesh, {.target_faces = mesh.face_count() / 3});
    test::for_vertices(mesh, [&](VertexId v) { mesh[v].is_fixed = true; });
    const ImproveResult done = improve(mesh, {});
    EXPECT_EQ(done.flips + done.moves, 0u);
}

TEST(Improve, moves_nothing_at_a_tolerance_of_nothing_on_a_curved_surface) {
    Mesh mesh = run(test::ball_volume({16, 16, 16}, 5.3), {.background = {}}).mesh;
    simplify(mesh, {.target_faces = mesh.face_count() / 3});
    const ImproveResult done = improve(mesh, {.tolerance = 0, .sweeps = 1});
    mesh = run(test::ball_volume({16, 16, 16}, 5.3), {.background = {}}).mesh;
    simplify(mesh, {.target_faces = mesh.face_count() / 3});
    const ImproveResult free = improve(mesh, {.sweeps = 1});
    EXPECT_LT(done.moves, free.moves) << "flat parts may still move in their plane";
}

/// A fifth of the faces, and what decimation leaves below the bound on quality (raise_floor() is not called).
Mesh decimated(test::ArrayVolume& volume, const Promises& promises) {
    Mesh mesh = run(volume, {.background = {}}).mesh;
    simplify(mesh, {.target_faces = mesh.face_count() / 5, .promises = promises});
    return mesh;
}

TEST(Improve, takes_faces_at_anisotropic_spacing_out_of_the_lowest_quality) {
    test::ArrayVolume volume = test::grain_volume({30, 28, 40}, 20, 7);
    volume.lattice().spacing = {0.4, 0.4, 0.12};
    const Promises promises{.min_quality = 0.1, .samples = volume.info().lattice, .scale = 0.4};
    Mesh mesh = decimated(volume, promises);
    const ImproveResult done = improve(mesh, {.promises = promises});
    expect_better(done);
    EXPECT_GT(done.before.faces_below, 20u) << "this test needs such faces";
    EXPECT_LT(3 * done.after.faces_below, done.before.faces_below);
}

TEST(Improve, collapses_short_edges_of_the_worst_faces) {
    test::ArrayVolume volume = test::noise_volume({12, 11, 16}, 4, 1);
    volume.lattice().spacing = {0.4, 0.4, 0.12};
    const Promises promises{.min_quality = 0.1, .samples = volume.info().lattice, .scale = 0.4};
    Mesh mesh = decimated(volume, promises);
    const ImproveResult done = improve(mesh, {.promises = promises});
    test::expect_sound(check(mesh));
    expect_better(done);
    EXPECT_GT(done.collapses, 0u);
    EXPECT_LT(5 * done.after.faces_below, 4 * done.before.faces_below);
}

TEST(Improve, shapes_are_those_of_the_model_without_the_scale_of_z) {
    ReconstructOptions options = improved(0.8);
    options.scale_z = 8;
    const Reconstruction made = run(test::grain_volume({12, 12, 12}, 6, 3), options);
    const FaceShapes& after = made.report.improved.value().after;
    EXPECT_NEAR(after.min_quality, made.report.check.quality.min, 1e-12);
    EXPECT_NEAR(after.mean_quality, made.report.check.quality.mean, 1e-12);
}

TEST(Improve, of_an_empty_mesh_does_nothing) {
    Mesh mesh;
    EXPECT_EQ(improve(mesh, {}).sweeps, 1u);
    EXPECT_EQ(mesh.face_count(), 0u);
}

TEST(Determinism, improve_gives_the_same_bytes_for_any_number_of_threads) {
    test::ArrayVolume volume = test::grain_volume({20, 18, 22}, 9, 3);
    std::set<std::uint64_t> digests;
    for (std::uint32_t threads : {1, 2, 5}) {
        ReconstructOptions options = improved(0.8);
        options.threads = threads;
        digests.insert(test::digest(run(volume, options).mesh));
    }
    EXPECT_EQ(digests.size(), 1u);
}

}  // namespace
}  // namespace regionmesh
