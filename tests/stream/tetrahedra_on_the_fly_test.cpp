// Models of tetrahedra: what may not change with order, threads and budget, and what the budget must hold.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "regionmesh/census.h"
#include "regionmesh/error.h"
#include "regionmesh/smooth.h"
#include "support/digest.h"
#include "support/meshes.h"
#include "support/runs.h"
#include "support/strata_list.h"

namespace regionmesh {
namespace {

using test::by_cells;
using test::expect_sound;
using test::plain;
using test::reduced;
using test::run;
using test::surface_digest;
using testing::HasSubstr;

std::string refusal(test::ArrayMesh mesh, const ReconstructOptions& options = plain()) {
    try {
        run(std::move(mesh), options);
    } catch (const Error& error) {
        return error.what();
    }
    return "nothing thrown";
}

/// The same surface with labels as the input has them: the same for any order in which they are met.
std::uint64_t labelled_digest(const Reconstruction& made) {
    Mesh mesh;
    test::for_vertices(made.mesh, [&](VertexId v) {
        while (mesh.vertex_end() <= index(v)) mesh.add_vertex(made.mesh.position(v));
    });
    test::for_faces(made.mesh, [&](FaceId f) {
        const Face& face = made.mesh[f];
        const auto label = [&](int n) {
            return is_exterior(face.labels[n]) ? face.labels[n] : static_cast<Label>(made.labels.input(face.labels[n]));
        };
        mesh.add_face(face.vertices[0], face.vertices[1], face.vertices[2], label(0), label(1));
    });
    return surface_digest(mesh);
}

void expect_the_same_in_any_order(const test::ArrayMesh& mesh, const std::vector<ReconstructOptions>& all) {
    for (const ReconstructOptions& options : all) {
        const Reconstruction expected = run(mesh, options);
        for (std::uint64_t seed : {1, 2}) {
            const Reconstruction made = run(mesh.shuffled(seed), options);
            EXPECT_EQ(labelled_digest(made), labelled_digest(expected));
            EXPECT_EQ(made.report.check.counts, expected.report.check.counts);
            EXPECT_EQ(made.report.verdicts, expected.report.verdicts);
        }
    }
}

const ReconstructOptions kSmoothed{.decimate = false, .background = {}},
    kSmoothedAndReduced{.reduce = 0.8, .background = {}};

TEST(Determinism, order_of_points_and_tetrahedra_does_not_matter) {
    expect_the_same_in_any_order(test::bent_mesh({12, 11, 13}, 8, 1),
                                 {plain(), kSmoothed, reduced(0.9), kSmoothedAndReduced});
    for (const test::ArrayMesh& mesh :
         {by_cells(test::bent_mesh({12, 11, 13}, 8, 2)), test::cell_mesh_of(test::noise_volume({6, 7, 8}, 3, 3))})
        expect_the_same_in_any_order(mesh, {plain(), kSmoothed});
}

/// Their labels are numbered as they are read, and decimation breaks ties by those numbers.
TEST(Determinism, order_of_labelled_tetrahedra_does_not_matter_to_decimation) {
    for (const test::ArrayMesh& mesh :
         {by_cells(test::bent_mesh({12, 11, 13}, 8, 2)), test::cell_mesh_of(test::noise_volume({6, 7, 8}, 3, 3))})
        expect_the_same_in_any_order(mesh, {reduced(0.9), kSmoothedAndReduced});
}

TEST(Determinism, tetrahedra_give_the_same_bytes_for_any_number_of_threads) {
    for (const test::ArrayMesh& mesh :
         {test::bent_mesh({14, 12, 16}, 8, 1), test::cell_mesh_of(test::noise_volume({8, 7, 12}, 3, 1))})
        for (ReconstructOptions options :
             {ReconstructOptions{.reduce = 0.8, .background = {}},
              ReconstructOptions{.target_faces = 800, .background = {}, .face_budget = 3000}}) {
            options.threads = 1;
            const std::uint64_t expected = test::digest(run(mesh, options).mesh);
            for (std::uint32_t threads : {2u, 3u, 4u}) {
                options.threads = threads;
                EXPECT_EQ(test::digest(run(mesh, options).mesh), expected) << threads << " threads";
            }
        }
}

/// A long bar, so that there are many strips.
test::ArrayMesh bar(std::uint32_t length) { return test::bent_mesh({9, 9, length}, length / 3, 6); }

TEST(OnTheFly, tetrahedra_within_a_face_budget_that_binds_leave_a_sound_model) {
    const test::ArrayMesh mesh = bar(60);
    const Reconstruction whole = run(mesh);
    for (bool smooths : {false, true})
        for (std::uint64_t budget : {3000u, 6000u}) {
            SCOPED_TRACE("budget " + std::to_string(budget));
            ReconstructOptions options{.target_faces = 2000, .background = {}, .face_budget = budget};
            if (!smooths) options.smooth.passes = 0;
            const Reconstruction made = run(mesh, options);
            ASSERT_GT(whole.report.initial_faces, 2 * budget) << "the budget does not bind";
            expect_sound(made.report.check);
            EXPECT_EQ(made.report.initial_faces, whole.report.initial_faces);
            EXPECT_LE(made.report.final_faces, 2000u);
            test::expect_same_strata(test::list_strata(made.mesh), test::list_strata(whole.mesh));
        }
}

TEST(Memory, peak_of_tetrahedra_does_not_grow_with_the_length_of_the_sweep) {
    const auto peak = [](std::uint32_t length) {
        const Reconstruction made =
            run(bar(length), {.target_faces = 1500, .smooth = {.passes = 0}, .background = {}, .face_budget = 4000});
        EXPECT_GT(made.report.initial_faces, 3 * made.report.peak_faces / 2);
        return made.report.peak_faces;
    };
    EXPECT_LE(peak(160), peak(80) * 12 / 10);
}

TEST(Equivalence, a_face_budget_that_never_binds_is_none_for_tetrahedra) {
    const test::ArrayMesh mesh = bar(30);
    const ReconstructOptions free{.target_faces = 1500, .background = {}};
    ReconstructOptions bounded = free;
    bounded.face_budget = 10000000;
    EXPECT_EQ(test::digest(run(mesh, bounded).mesh), test::digest(run(mesh, free).mesh));
}

TEST(Equivalence, strips_per_chunk_changes_nothing_for_tetrahedra) {
    const test::ArrayMesh mesh = bar(30);
    for (ReconstructOptions options : {plain(), ReconstructOptions{.decimate = false, .background = {}}}) {
        const std::uint64_t expected = surface_digest(run(mesh, options).mesh);
        for (std::uint32_t strips : {2u, 5u, 1000u}) {
            options.strips_per_chunk = strips;
            EXPECT_EQ(surface_digest(run(mesh, options).mesh), expected);
        }
    }
}

/// The filter and its rounds of stepping back on the whole of the plain model.
void expect_smoothed_as_in_core(const test::ArrayMesh& mesh, const SmoothOptions& filter) {
    Reconstruction plain_run = run(mesh);
    test::ArrayMesh counted = mesh;
    SmoothOptions in_core = filter;
    in_core.scale = count_labels(counted).spacing;
    smooth(plain_run.mesh, in_core);
    const Reconstruction streamed = run(mesh, {.smooth = filter, .decimate = false, .background = {}});
    EXPECT_EQ(streamed.report.smoothing.held_vertices, 0u);
    EXPECT_EQ(surface_digest(streamed.mesh), surface_digest(plain_run.mesh));
}

TEST(Equivalence, smoothing_of_tetrahedra_on_the_fly_is_smoothing_in_core) {
    for (const test::ArrayMesh& mesh : {test::bent_mesh({7, 6, 20}, 9, 3), by_cells(test::bent_mesh({7, 6, 20}, 4, 3))})
        for (const SmoothOptions& filter :
             {SmoothOptions{.intersect_check = false},
              {.passes = 3, .intersect_check = false},
              {.filter = SmoothFilter::kLaplacian, .passes = 5, .intersect_check = false}})
            expect_smoothed_as_in_core(mesh, filter);
}

/// Layers of tetrahedra overlap: faces within the reach of the filter may lie in layers further ahead than it looks.
TEST(Equivalence, nifpms_of_tetrahedra_on_the_fly_is_nifpms_in_core) {
    for (std::uint64_t seed : {1, 2, 4, 5})
        for (const test::ArrayMesh& mesh :
             {test::bent_mesh({5, 6, 20}, 3, seed), by_cells(test::bent_mesh({5, 6, 20}, 3, seed))}) {
            SCOPED_TRACE("seed " + std::to_string(seed));
            expect_smoothed_as_in_core(mesh, {.filter = SmoothFilter::kNifpms, .intersect_check = false});
        }
}

TEST(Memory, memory_that_is_short_gives_a_sound_model_or_says_how_much_is_needed) {
    const test::ArrayMesh mesh = bar(60);
    EXPECT_THAT(refusal(mesh, {.reduce = 0.9, .memory = 1000}), HasSubstr("--memory"));
    ReconstructOptions options{.reduce = 0.95, .background = {}};
    for (options.memory = 8'000'000; options.memory < 64'000'000; options.memory += 4'000'000) {
        if (refusal(mesh, options) != "nothing thrown") {
            EXPECT_THAT(refusal(mesh, options), HasSubstr("--memory"));
            continue;
        }
        expect_sound(run(mesh, options).report.check);
        return;
    }
    FAIL() << "64 MB are not enough";
}

}  // namespace
}  // namespace regionmesh
