#include "stream/budget.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "cells/strip_mesher.h"
#include "regionmesh/census.h"
#include "regionmesh/error.h"
#include "regionmesh/reconstruct.h"
#include "stream/footprint.h"
#include "support/digest.h"
#include "support/runs.h"

namespace regionmesh {
namespace {

using test::run;
using testing::HasSubstr;

/// A volume of 100 x 100 samples a section and so many strips of 1000 faces each, to be decimated to a tenth.
BudgetDemand even_demand(std::uint32_t strips, std::uint64_t faces = 1000) {
    const VolumeInfo volume = test::solid_volume({100, 100, strips + 1}).info();
    return {.source = volume.source,
            .reading_bytes = reading_bytes(volume),
            .strip_faces = std::vector<std::uint64_t>(strips, faces),
            .window_bytes = std::vector<std::uint64_t>(strips, 100 * faces),
            .window_strips = 32,
            .chunk_strips = 32,
            .fewest_chunk_strips = 4,
            .tiles = 25,
            .tiles_in_flight = 16,
            .target_share = 0.1,
            .tile_share = 0.5,
            .is_decimating = true};
}
constexpr std::uint64_t kPlenty = std::uint64_t{1} << 40;

std::uint64_t least(const BudgetDemand& demand) { return plan_budget(kPlenty, demand).least.sum(); }

std::string refusal(std::uint64_t memory, const BudgetDemand& demand) {
    try {
        require_budget(plan_budget(memory, demand), demand);
    } catch (const Error& error) {
        return error.what();
    }
    return "nothing thrown";
}

TEST(Budget, holds_from_the_least_memory_on) {
    for (std::uint32_t strips : {1u, 7u, 100u}) {
        BudgetDemand demand = even_demand(strips, 20000);
        demand.fewest_chunk_strips = demand.chunk_strips;
        const std::uint64_t memory = plan_budget(1, demand).least.sum();
        EXPECT_TRUE(plan_budget(memory, demand).holds());
        EXPECT_FALSE(plan_budget(memory - 1, demand).holds());
        EXPECT_EQ(refusal(memory, demand), "nothing thrown");
    }
}

TEST(Budget, a_refusal_says_how_much_would_do_and_what_to_change) {
    const BudgetDemand demand = even_demand(100, 20000);
    const std::string text = refusal(20'000'000, demand);
    EXPECT_THAT(text, HasSubstr("--memory 20 MB"));
    EXPECT_THAT(text, HasSubstr("needs at least"));
    EXPECT_THAT(text, HasSubstr("--smooth"));
    BudgetDemand whole = demand;
    whole.target_share = 0.9;
    whole.tile_share = 1;
    EXPECT_THAT(refusal(20'000'000, whole), HasSubstr("lower target"));
}

TEST(Budget, runs_are_shortened_only_where_the_usual_do_not_fit) {
    BudgetDemand demand = even_demand(128, 20000);
    demand.window_strips = 0;
    const std::uint64_t memory = least(demand);
    EXPECT_EQ(plan_budget(memory, demand).chunk_strips, 32u);
    EXPECT_EQ(plan_budget(memory, demand).in_flight, 16u);
    const Budget leaner = plan_budget(memory - 1, demand);
    EXPECT_TRUE(leaner.holds());
    EXPECT_LT(leaner.in_flight, 16u) << "which does not change the result";
    EXPECT_EQ(leaner.chunk_strips, 32u);
    const Budget shorter = plan_budget(memory / 2, demand);
    EXPECT_TRUE(shorter.holds());
    EXPECT_EQ(shorter.chunk_strips, 16u);
    EXPECT_EQ(plan_budget(1, demand).chunk_strips, 4u);
}

TEST(Budget, more_sections_need_no_more) {
    // A target of so many faces; its share falls as the sections grow more.
    BudgetDemand demand = even_demand(100);
    const std::uint64_t once = least(demand);
    for (std::uint32_t times : {2u, 4u, 16u}) {
        BudgetDemand more = even_demand(100 * times);
        more.target_share = demand.target_share / times;
        EXPECT_LE(least(more), once + once / 100) << times << " times the sections";
    }
}

TEST(Budget, the_window_counts_the_strips_that_it_will_hold) {
    BudgetDemand even = even_demand(100), uneven = even;
    even.target_share = uneven.target_share = 0;
    std::fill(uneven.window_bytes.begin() + 40, uneven.window_bytes.begin() + 60, 5000 * 100);
    const MemoryNeed a = plan_budget(kPlenty, even).least, b = plan_budget(kPlenty, uneven).least;
    EXPECT_EQ(a.window, 32u * 1000 * 100);
    EXPECT_EQ(b.window, (20u * 5000 + 12 * 1000) * 100);
}

TEST(Budget, a_run_is_largest_in_the_end_where_its_model_outgrows_its_window) {
    BudgetDemand demand = even_demand(100, 20000);  // a window of 64 MB
    const Budget small = plan_budget(kPlenty, demand);
    EXPECT_FALSE(small.is_largest_in_the_end);
    EXPECT_EQ(small.in_the_end, kProcessBytes + 200'000 * kBytesPerFace);
    demand.target_share = 0.9;
    demand.tile_share = 1;
    const Budget large = plan_budget(kPlenty, demand);
    EXPECT_TRUE(large.is_largest_in_the_end);
    EXPECT_EQ(large.in_the_end, kProcessBytes + 1'800'000 * kBytesPerFace);
    EXPECT_LT(large.in_the_end, large.least.sum());
    demand.target_share = 0;  // an error is bounded, so that nothing is known of the model
    EXPECT_FALSE(plan_budget(kPlenty, demand).is_largest_in_the_end);
    EXPECT_EQ(plan_budget(kPlenty, demand).in_the_end, kProcessBytes);
}

TEST(Budget, what_is_not_taken_otherwise_is_the_models) {
    const BudgetDemand demand = even_demand(64);
    const Budget small = plan_budget(200'000'000, demand), large = plan_budget(300'000'000, demand);
    EXPECT_EQ(large.face_budget(1) - small.face_budget(1), 1'000'000u);
    EXPECT_EQ(small.room_before(1, 500), small.face_budget(1) - 500);
    EXPECT_LE(large.room_before(1, 0) * kMeshBytesPerFace + large.chunks[1].gathering, 300'000'000u);
    EXPECT_EQ(plan_budget(kPlenty, demand).face_budget(0), kMostFaces);
}

TEST(Budget, a_face_budget_that_is_asked_for_stands) {
    BudgetDemand demand = even_demand(64);
    demand.asked_budget = 5000;
    const Budget plan = plan_budget(1, demand);
    EXPECT_TRUE(plan.holds());
    EXPECT_EQ(plan.face_budget(1), 5000u);
    EXPECT_EQ(plan.room_before(1, 2000), 3000u);
}

TEST(Budget, the_next_run_is_expected_to_keep_as_much_as_the_last) {
    BudgetDemand demand = even_demand(64);
    std::fill(demand.strip_faces.begin() + 32, demand.strip_faces.end(), 3000);
    EXPECT_EQ(plan_budget(kPlenty, demand).expected_faces(1, 10000), 30000u);
}

TEST(Budget, the_next_chunk_is_gathered_ahead_only_where_both_fit) {
    Budget budget = plan_budget(kPlenty, even_demand(100));
    ASSERT_GE(budget.chunks.size(), 3u);
    EXPECT_TRUE(budget.has_room_ahead(0, 1000));
    EXPECT_FALSE(budget.has_room_ahead(budget.chunks.size() - 1, 1000));  // nothing comes after it
    budget.memory = budget.chunks[0].gathering + (1000 + 32 * 1000) * kChunkBytesPerFace;
    EXPECT_TRUE(budget.has_room_ahead(0, 1000));
    EXPECT_FALSE(budget.has_room_ahead(0, 1001));
}

TEST(Budget, gathering_ahead_has_the_larger_window_of_both_chunks) {
    BudgetDemand demand = even_demand(100);
    demand.window_strips = 4;
    std::fill(demand.strip_faces.begin() + 32, demand.strip_faces.end(), 3000);
    std::fill(demand.window_bytes.begin() + 32, demand.window_bytes.end(), 3000 * 64);
    Budget budget = plan_budget(kPlenty, demand);
    const ChunkMemory &now = budget.chunks[0], &next = budget.chunks[1];
    ASSERT_GT(next.gathering - next.tiles, now.gathering - now.tiles);
    budget.memory = next.gathering - next.tiles + now.tiles + (1000 + next.faces) * kChunkBytesPerFace;
    EXPECT_TRUE(budget.has_room_ahead(0, 1000));
    EXPECT_FALSE(budget.has_room_ahead(0, 1001));
}

TEST(Census, counts_the_faces_of_each_strip) {
    test::ArrayVolume volume = test::grain_volume({12, 11, 10}, 6, 3);
    const Census census = count_labels(volume, {.background = {}, .cells = CellKind::kTetrahedra});
    volume.rewind();
    const Lattice lattice = volume.info().lattice;
    StripMesher mesher(lattice, volume.info().sweep, {});
    std::vector<std::vector<Label>> sections(10, std::vector<Label>(132));
    std::vector<InputLabel> input(132);
    for (auto& section : sections) {
        volume.next(input);
        std::copy(input.begin(), input.end(), section.begin());
    }
    ASSERT_EQ(census.strip_faces.size(), 9u);
    for (std::size_t n = 0; n < 9; ++n) {
        Chunk chunk;
        mesher.mesh(sections[n], sections[n + 1], chunk);
        EXPECT_EQ(census.strip_faces[n], chunk.faces.size()) << "strip " << n;
    }
}

/// Bytes that run and model took at most: what is measured here is not shared with other tests, as peak_bytes is.
std::uint64_t bytes_held(const Report& report) {
    return report.smoothing.window_bytes +
           static_cast<std::uint64_t>(report.bytes_per_face * static_cast<double>(report.peak_faces));
}

TEST(Memory, twice_and_four_times_the_sections_take_no_more) {
    for (std::uint32_t passes : {0u, 1u}) {
        SCOPED_TRACE(std::to_string(passes) + " passes");
        const ReconstructOptions options{.target_faces = 4000,
                                         .cells = CellKind::kTetrahedra,
                                         .smooth = {.filter = SmoothFilter::kTaubin, .passes = passes},
                                         .keep_samples = false,
                                         .background = {},
                                         .memory = passes == 0 ? 23'500'000u : 25'000'000u};
        const Report once = run(test::grain_blocks(16, 12), options).report;
        EXPECT_EQ(once.stopped, StopReason::kTarget);
        for (std::uint32_t times : {2u, 4u}) {
            const Report more = run(test::grain_blocks(16, 12 * times), options).report;
            EXPECT_GT(more.initial_faces, once.initial_faces * times * 9 / 10);
            EXPECT_LE(bytes_held(more), bytes_held(once) * 11 / 10) << times << " times the sections";
        }
    }
}

TEST(Budget, a_refusal_says_when_the_memory_is_the_default) {
    const BudgetDemand demand = even_demand(100, 20000);
    EXPECT_THAT(refusal(20'000'000, demand), testing::Not(HasSubstr("default")));
    BudgetDemand large = demand;
    large.reading_bytes = std::uint64_t{3} << 30;
    EXPECT_THAT(refusal(ReconstructOptions{}.memory, large), HasSubstr("--memory 2147 MB (the default): "));
}

TEST(Memory, a_target_that_does_not_fit_is_refused_before_reading_for_the_model_begins) {
    test::ArrayVolume volume = test::grain_blocks(24, 12);
    std::set<std::string> stages;
    try {
        reconstruct(volume, {.target_faces = 200000, .background = {}, .memory = 26'000'000},
                    [&](const Progress& progress) { stages.insert(progress.stage); });
        ADD_FAILURE() << "not refused";
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("needs at least"));
    }
    EXPECT_THAT(stages, testing::ElementsAre("count"));
}

TEST(Determinism, memory_that_does_not_bind_and_threads_change_nothing) {
    for (std::uint32_t passes : {0u, 3u})
        for (const ReconstructOptions& goal :
             {ReconstructOptions{.reduce = 0.9}, ReconstructOptions{.promises = {.max_error = 0.1}}}) {
            SCOPED_TRACE(std::to_string(passes) + " passes");
            test::ArrayVolume volume = test::grain_volume({20, 20, 20}, 10, 2);
            ReconstructOptions options = goal;
            options.smooth.passes = passes;
            options.background = {};
            options.threads = 1;
            const std::uint64_t expected = test::digest(run(volume, options).mesh);
            for (std::uint64_t memory : {std::uint64_t{100} << 20, std::uint64_t{300} << 20, std::uint64_t{1} << 40})
                for (std::uint32_t threads : {1u, 2u, 3u, 8u}) {
                    if (memory != std::uint64_t{300} << 20 && threads == 3) continue;
                    options.memory = memory;
                    options.threads = threads;
                    EXPECT_EQ(test::digest(run(volume, options).mesh), expected)
                        << threads << " threads, " << memory << " bytes";
                }
        }
}

TEST(Determinism, memory_that_binds_gives_the_same_bytes_on_any_number_of_threads) {
    test::ArrayVolume volume = test::grain_blocks(16, 16);
    ReconstructOptions options{.target_faces = 4000,
                               .smooth = {.filter = SmoothFilter::kTaubin, .passes = 1},
                               .background = {},
                               .memory = 24'500'000,
                               .threads = 1};
    const Reconstruction one = run(volume, options);
    options.memory = std::uint64_t{2} << 30;
    EXPECT_LT(one.report.peak_faces, run(volume, options).report.peak_faces) << "24.5 MB do not bind";
    options.memory = 24'500'000;
    for (std::uint32_t threads : {2u, 3u, 8u}) {
        options.threads = threads;
        EXPECT_EQ(test::digest(run(volume, options).mesh), test::digest(one.mesh)) << threads << " threads";
    }
}

}  // namespace
}  // namespace regionmesh
