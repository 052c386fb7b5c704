// What may not change with the budget, and what the budget must hold: equivalence, determinism, memory.
#include <gtest/gtest.h>

#include <algorithm>

#include "support/digest.h"
#include "support/runs.h"
#include "support/strata_list.h"

namespace regionmesh {
namespace {

using test::run;

ReconstructOptions with_budget(std::uint64_t target, std::uint64_t budget) {
    ReconstructOptions options{.target_faces = target, .cells = CellKind::kTetrahedra, .background = {}};
    options.face_budget = budget;
    return options;
}

TEST(Equivalence, strips_per_chunk_changes_nothing_while_the_budget_does_not_bind) {
    for (std::uint64_t target : {1000000u, 1500u}) {
        test::ArrayVolume volume = test::grain_volume({16, 15, 14}, 8, 1);
        ReconstructOptions options = with_budget(target, 10000000);
        const Reconstruction one = run(volume, options);
        options.strips_per_chunk = 1000;
        const Reconstruction all = run(volume, options);
        EXPECT_EQ(test::digest(one.mesh), test::digest(all.mesh));
        EXPECT_EQ(one.report.verdicts, all.report.verdicts);
        EXPECT_LE(one.report.final_faces, target);
    }
}

TEST(Equivalence, a_budget_that_never_binds_is_no_budget) {
    test::ArrayVolume volume = test::noise_volume({9, 9, 9}, 4, 1);
    const Reconstruction bounded = run(volume, with_budget(3000, 10000000));
    ReconstructOptions unbounded = with_budget(3000, 0);
    unbounded.face_budget.reset();
    EXPECT_EQ(test::digest(bounded.mesh), test::digest(run(volume, unbounded).mesh));
}

TEST(Determinism, the_same_run_twice_gives_the_same_bytes) {
    test::ArrayVolume volume = test::grain_volume({20, 20, 20}, 10, 2);
    for (const ReconstructOptions& options : {test::plain(), test::reduced(0.9), with_budget(1500, 6000)})
        EXPECT_EQ(test::digest(run(volume, options).mesh), test::digest(run(volume, options).mesh));
}

TEST(Determinism, what_ran_before_does_not_matter) {
    test::ArrayVolume volume = test::noise_volume({9, 9, 9}, 4, 2);
    const std::uint64_t first = test::digest(run(volume, test::reduced(0.8)).mesh);
    run(test::grain_volume({20, 20, 20}, 10, 2), with_budget(1500, 6000));
    EXPECT_EQ(test::digest(run(volume, test::reduced(0.8)).mesh), first);
}

TEST(OnTheFly, a_budget_that_binds_leaves_a_sound_model) {
    test::ArrayVolume volume = test::grain_blocks(20, 2);
    const Reconstruction whole = run(volume);
    for (std::uint64_t budget : {4000u, 6000u, 10000u}) {
        SCOPED_TRACE("budget " + std::to_string(budget));
        const Reconstruction made = run(volume, with_budget(2500, budget));
        ASSERT_GT(whole.report.initial_faces, 2 * budget) << "the budget does not bind";
        test::expect_sound(made.report.check);
        EXPECT_EQ(made.report.initial_faces, whole.report.initial_faces);
        EXPECT_LE(made.report.final_faces, 2500u);
        test::expect_same_strata(test::list_strata(made.mesh), test::list_strata(whole.mesh));
    }
}

TEST(OnTheFly, noise_beyond_the_budget_stays_sound) {
    for (std::uint64_t seed : {1, 2, 3}) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        test::ArrayVolume volume = test::noise_volume({8, 8, 16}, 3, seed);
        const Reconstruction made = run(volume, with_budget(1000, 3000));
        test::expect_sound(made.report.check);
        test::expect_same_strata(test::list_strata(made.mesh), test::list_strata(run(volume).mesh));
    }
}

TEST(OnTheFly, backgrounds_and_open_boxes_stay_sound) {
    test::ArrayVolume volume = test::grain_blocks(16, 2);
    ReconstructOptions options = with_budget(1500, 4000);
    options.background = {0, 1};
    test::expect_sound(run(volume, options).report.check);
    options.background = {};
    options.cap = false;
    test::expect_sound(run(volume, options).report.check);
}

TEST(OnTheFly, a_ball_of_few_faces_that_has_outgrown_its_first_box_stays_sound) {
    ReconstructOptions options = with_budget(0, 422);
    options.background = {0};
    options.promises.min_quality = 0;
    test::expect_sound(run(test::ball_volume({14, 14, 14}, 4.5), options).report.check);
}

TEST(OnTheFly, every_sweep_and_chunk_stays_sound) {
    for (const Sweep& sweep : {kSweepX, kSweepY, kSweepZ})
        for (std::uint32_t strips : {1u, 3u}) {
            test::ArrayVolume volume = test::grain_volume({18, 20, 22}, 9, 3).spaced({1, 2, 5}).swept(sweep);
            ReconstructOptions options = with_budget(2000, 5000);
            options.strips_per_chunk = strips;
            test::expect_sound(run(volume, options).report.check);
        }
}

/// A run of strips is decimated and joins the model as one: the budget may be passed by so many faces.
constexpr std::uint64_t kFacesOfChunk = 10000;

TEST(Memory, peak_is_near_the_budget) {
    test::ArrayVolume volume = test::grain_blocks(16, 10);
    for (std::uint64_t budget : {10000u, 20000u}) {
        const Reconstruction made = run(volume, with_budget(5000, budget));
        EXPECT_GT(made.report.initial_faces, 2 * budget);
        EXPECT_LE(made.report.peak_faces, budget + kFacesOfChunk);
    }
}

TEST(Memory, peak_does_not_grow_with_the_number_of_sections) {
    const Reconstruction half = run(test::grain_blocks(16, 16), with_budget(4000, 12000));
    const Reconstruction whole = run(test::grain_blocks(16, 32), with_budget(8000, 12000));
    EXPECT_GT(whole.report.initial_faces, half.report.initial_faces * 19 / 10);
    EXPECT_LE(whole.report.peak_faces, half.report.peak_faces * 11 / 10);
}

/// Of noise, the largest error leaves nearly all faces.
TEST(Memory, faces_left_that_do_not_fit_are_said_during_the_run) {
    test::ArrayVolume volume = test::noise_volume({8, 8, 120}, 4, 1);
    ReconstructOptions options = test::reduced(0.95);
    options.promises.max_error = 1e-6;
    options.memory = 27'000'000;
    std::uint64_t needed = 0;
    std::uint32_t at = 0;
    const auto note = [&](const Progress& progress) {
        if (progress.bytes_needed == 0 || needed > 0) return;
        needed = progress.bytes_needed;
        at = progress.strips_read;
    };
    volume.rewind();
    const Reconstruction made = reconstruct(volume, options, note);
    EXPECT_GT(needed, options.memory);
    EXPECT_LT(at, 80u) << "too late to stop the run";
    EXPECT_GT(needed, made.report.final_faces * 80);
    EXPECT_LT(needed, made.report.final_faces * 150 + 30'000'000);
    options.memory = 200'000'000;
    needed = 0;
    volume.rewind();
    reconstruct(volume, options, note);
    EXPECT_EQ(needed, 0u);
}

}  // namespace
}  // namespace regionmesh
