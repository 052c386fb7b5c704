// Smoothing on the fly: equivalence, determinism, memory, anisotropy; and all filters leave a valid mesh.
#include "smooth/smoother.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>

#include "cells/strip_mesher.h"
#include "regionmesh/error.h"
#include "regionmesh/smooth.h"
#include "stream/merger.h"
#include "support/digest.h"
#include "support/runs.h"
#include "support/strata_list.h"
#include "volume/section_window.h"

namespace regionmesh {
namespace {

using test::kVertexFilters;
using test::run;

std::string name_of(const SmoothOptions& options) {
    const char* names[] = {"auto", "lattice", "taubin", "laplacian", "nifpms"};
    return std::string(names[static_cast<int>(options.filter)]) + ", " + std::to_string(options.passes) + " passes";
}

/// All labels are regions; smoothed so, by taubin where nothing else is given, and not decimated.
ReconstructOptions smoothed(SmoothOptions smooth = {}) {
    if (smooth.filter == SmoothFilter::kAuto) smooth.filter = SmoothFilter::kTaubin;
    return {.cells = CellKind::kTetrahedra, .smooth = smooth, .decimate = false, .background = {}};
}

/// The filter and its rounds of backtracking on the whole mesh, as reconstruct() does them strip by strip. What is
/// left of intersections is resolved strip by strip: there other vertices may backtrack than in core.
Mesh smoothed_in_core(test::ArrayVolume& volume, ReconstructOptions options) {
    const Vec3 spacing = volume.info().lattice.spacing;
    SmoothOptions smooth_options = options.smooth;
    smooth_options.min_quality = options.promises.quality_bound();
    smooth_options.intersect_check = options.promises.intersect_check;
    smooth_options.scale = std::cbrt(spacing.x * spacing.y * spacing.z);
    options.smooth.passes = 0;
    Reconstruction plain = run(volume, options);
    smooth(plain.mesh, smooth_options);
    return std::move(plain.mesh);
}

void expect_smoothed_as_in_core(test::ArrayVolume& volume, const ReconstructOptions& options) {
    SCOPED_TRACE(name_of(options.smooth));
    const Reconstruction streamed = run(volume, options);
    if (options.promises.intersect_check) test::expect_sound(streamed.report.check);
    EXPECT_EQ(streamed.report.smoothing.held_vertices, 0u);
    EXPECT_EQ(test::surface_digest(streamed.mesh), test::surface_digest(smoothed_in_core(volume, options)));
}

/// Balls of 1 in 0, one after the other along z, with sections of 0 alone between them and at both ends.
test::ArrayVolume beads(std::uint32_t count) {
    std::vector<InputLabel> labels;
    for (std::uint32_t z = 0; z < 12 * count; ++z)
        for (int y = 0; y < 9; ++y)
            for (int x = 0; x < 9; ++x) labels.push_back(length2({x - 4.0, y - 4.0, z % 12 - 6.0}) < 9);
    return {{9, 9, 12 * count}, std::move(labels)};
}

// Equivalence.

TEST(Equivalence, smoothed_strips_do_not_depend_on_how_many_come_at_once) {
    for (SmoothFilter filter : kVertexFilters) {
        test::ArrayVolume volume = test::grain_volume({10, 9, 14}, 6, 1);
        ReconstructOptions options = smoothed({.filter = filter});
        const std::uint64_t one = test::digest(run(volume, options).mesh);
        for (std::uint32_t strips : {3u, 1000u}) {
            options.strips_per_chunk = strips;
            EXPECT_EQ(test::digest(run(volume, options).mesh), one);
        }
    }
}

TEST(Equivalence, smoothing_on_the_fly_is_smoothing_in_core_on_grains) {
    test::ArrayVolume volume = test::grain_volume({9, 10, 16}, 8, 3);
    for (const SmoothOptions& smooth : {SmoothOptions{},
                                        {.passes = 1},
                                        {.passes = 2},
                                        {.filter = SmoothFilter::kLaplacian, .passes = 5},
                                        {.filter = SmoothFilter::kNifpms}})
        expect_smoothed_as_in_core(volume, smoothed(smooth));
    for (const Sweep& sweep : {kSweepX, kSweepY}) expect_smoothed_as_in_core(volume.swept(sweep), smoothed());
}

TEST(Equivalence, smoothing_on_the_fly_is_smoothing_in_core_on_noise) {
    for (std::uint64_t seed : {1, 2}) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        test::ArrayVolume volume = test::noise_volume({6, 5, 18}, 4, seed);
        expect_smoothed_as_in_core(volume, smoothed());
        expect_smoothed_as_in_core(volume, smoothed({.move_points = true}));
    }
}

TEST(Equivalence, smoothing_on_the_fly_is_smoothing_in_core_without_caps_and_with_background) {
    test::ArrayVolume volume = test::grain_volume({12, 12, 18}, 7, 2);
    ReconstructOptions options = smoothed();
    options.background = {0, 3};
    expect_smoothed_as_in_core(volume, options);
    options.cap = false;
    expect_smoothed_as_in_core(volume, options);
}

TEST(Equivalence, smoothing_on_the_fly_is_smoothing_in_core_at_any_spacing) {
    for (const Vec3 spacing : {Vec3{1, 2, 5}, Vec3{1, 1, 0.2}, Vec3{1e-3, 1e-3, 2e-3}}) {
        test::ArrayVolume volume = test::grain_volume({9, 9, 14}, 6, 2).spaced(spacing);
        expect_smoothed_as_in_core(volume, smoothed());
        ReconstructOptions nifpms = smoothed({.filter = SmoothFilter::kNifpms});
        nifpms.promises.intersect_check = false;
        nifpms.promises.min_quality = 0;
        expect_smoothed_as_in_core(volume, nifpms);
    }
}

TEST(Equivalence, strips_without_faces_are_passed_through) {
    test::ArrayVolume volume = beads(2);
    for (SmoothFilter filter : kVertexFilters) {
        ReconstructOptions options = smoothed({.filter = filter});
        options.background = {0};
        expect_smoothed_as_in_core(volume, options);
        EXPECT_GT(run(volume, options).report.smoothing.rms_displacement, 0.01);
    }
    for (SmoothFilter filter : kVertexFilters) {
        const Reconstruction nothing = run(test::solid_volume({4, 4, 9}, 0), {.smooth = {.filter = filter}});
        EXPECT_EQ(nothing.mesh.face_count(), 0u);
        EXPECT_EQ(nothing.report.smoothing.vertices, 0u);
    }
}

TEST(Equivalence, a_volume_of_two_sections_is_smoothed_too) {
    for (SmoothFilter filter : kVertexFilters) {
        const Reconstruction made = run(test::noise_volume({8, 8, 2}, 3, 1), smoothed({.filter = filter}));
        test::expect_sound(made.report.check);
        EXPECT_GT(made.report.smoothing.rms_displacement, 0.01);
    }
}

// Chunk by chunk.

/// Meshes, smooths, and calls visit(chunk in, chunk out) for each pair, in order.
template <class Visit>
void for_chunks(test::ArrayVolume& volume, Smoother& smoother, Visit&& visit) {
    LabelTable labels;
    SectionWindow window(volume, labels);
    StripMesher mesher(volume.info().lattice, volume.info().sweep, {});
    std::deque<Chunk> in;
    Chunk out;
    double plane = 0;
    while (window.advance()) {
        in.emplace_back();
        mesher.mesh(window.low(), window.high(), in.back());
        plane += volume.info().lattice.spacing[volume.info().sweep.axes[2]];
        EXPECT_TRUE(smoother.add(in.back(), window.is_last(), plane));
        while (smoother.next(out)) {
            visit(in.front(), out);
            in.pop_front();
        }
    }
    EXPECT_TRUE(in.empty()) << "after the last strip all come out";
    EXPECT_FALSE(smoother.next(out));
}

TEST(Smoother, chunks_come_out_as_they_went_in_except_for_positions) {
    for (SmoothFilter filter : kVertexFilters) {
        test::ArrayVolume volume = test::noise_volume({5, 5, 12}, 3, 4);
        Smoother smoother({.filter = filter, .passes = 4}, {.thickness = 1});
        Merger merger;
        for_chunks(volume, smoother, [&](const Chunk& in, const Chunk& out) {
            EXPECT_EQ(out.carried, in.carried);
            EXPECT_EQ(out.active, in.active);
            ASSERT_EQ(out.vertices.size(), in.vertices.size());
            ASSERT_EQ(out.faces.size(), in.faces.size());
            for (std::size_t v = 0; v < in.vertices.size(); ++v) EXPECT_EQ(out.vertices[v].sides, in.vertices[v].sides);
            for (std::size_t f = 0; f < in.faces.size(); ++f) {
                EXPECT_EQ(out.faces[f].vertices, in.faces[f].vertices);
                EXPECT_EQ(out.faces[f].labels, in.faces[f].labels);
            }
            merger.add(out);
        });
        test::expect_sound(check(merger.take_mesh()));
    }
}

TEST(Smoother, strips_come_out_while_others_go_in) {
    test::ArrayVolume volume = test::noise_volume({5, 5, 60}, 3, 4);
    Smoother smoother({.filter = SmoothFilter::kTaubin, .passes = 4}, {.thickness = 1});
    int strips = 0;
    for_chunks(volume, smoother, [&](const Chunk&, const Chunk&) { ++strips; });
    EXPECT_EQ(strips, 59);
    EXPECT_LT(smoother.report().window_chunks, 30u);
}

TEST(Smoother, the_safe_interval_ends_before_all_surface_not_handed_out) {
    for (SmoothFilter filter : kVertexFilters)
        for (const Sweep& sweep : {kSweepX, kSweepZ}) {
            const bool is_local = filter != SmoothFilter::kNifpms;
            test::ArrayVolume volume =
                (is_local ? test::noise_volume({24, 5, 24}, 3, 4) : test::grain_volume({24, 5, 24}, 9, 4))
                    .swept(sweep)
                    .spaced({0.5, 1, 1});
            const int axis = sweep.axes[2];
            const double thickness = volume.info().lattice.spacing[axis];
            Smoother smoother({.filter = filter, .passes = 5, .scale = 0.8}, {.axis = axis, .thickness = thickness});
            double safe_high = -HUGE_VAL, last = 0;
            for_chunks(volume, smoother, [&](const Chunk&, const Chunk& out) {
                for (const ChunkVertex& vertex : out.vertices) ASSERT_GE(vertex.position[axis], safe_high);
                safe_high = smoother.safe_high();
                if (safe_high < HUGE_VAL) last = safe_high;
            });
            EXPECT_GT(last, 5 * thickness) << "the safe interval does not follow the sweep";
        }
}

// Determinism.

TEST(Determinism, smoothing_gives_the_same_bytes_on_any_number_of_threads) {
    test::ArrayVolume volume = test::grain_volume({40, 28, 36}, 16, 11);
    for (double share : {0.0, 0.9}) {
        ReconstructOptions options = test::reduced(share);
        options.decimate = share > 0;
        options.smooth = {};
        options.threads = 1;
        const std::uint64_t one = test::digest(run(volume, options).mesh);
        for (std::uint32_t threads : {2u, 3u, 8u}) {
            if (share == 0 && threads != 3) continue;
            options.threads = threads;
            EXPECT_EQ(test::digest(run(volume, options).mesh), one) << threads << " threads";
        }
    }
}

TEST(Determinism, every_filter_gives_the_same_bytes_on_any_number_of_threads) {
    for (const SmoothOptions& smooth :
         {SmoothOptions{.filter = SmoothFilter::kLaplacian, .passes = 40}, {.filter = SmoothFilter::kNifpms}}) {
        test::ArrayVolume volume = smooth.filter == SmoothFilter::kNifpms ? test::grain_volume({12, 12, 10}, 6, 5)
                                                                          : test::noise_volume({12, 12, 10}, 3, 5);
        ReconstructOptions options = test::reduced(0.8);
        options.smooth = smooth;
        options.threads = 1;
        const std::uint64_t one = test::digest(run(volume, options).mesh);
        options.threads = 3;
        EXPECT_EQ(test::digest(run(volume, options).mesh), one);
    }
}

// Memory.

/// Small sections, many of them.
test::ArrayVolume column(std::uint32_t sections) { return test::noise_volume({5, 5, sections}, 2, 1); }

/// The same with a wall in place of noise, and nothing else: few faces for a slow filter.
SmoothReport wall(std::uint32_t sections, const SmoothOptions& smooth) {
    std::vector<InputLabel> labels;
    for (std::uint32_t n = 0; n < 25 * sections; ++n) labels.push_back(n % 5 < 2 + n / 75 % 2);
    ReconstructOptions options = smoothed(smooth);
    options.background = {0, 1};
    return run(test::ArrayVolume({5, 5, sections}, std::move(labels)), options).report.smoothing;
}

TEST(Memory, smoothing_holds_as_many_strips_however_many_there_are) {
    const auto expect_same_window = [](const SmoothReport& half, const SmoothReport& whole) {
        EXPECT_GT(whole.vertices, half.vertices * 19 / 10);
        EXPECT_LT(half.window_chunks, 50u);
        EXPECT_EQ(whole.window_chunks, half.window_chunks);
        EXPECT_LE(whole.window_bytes, half.window_bytes * 11 / 10);
    };
    for (const SmoothOptions& smooth :
         {SmoothOptions{}, {.passes = 5}, {.filter = SmoothFilter::kLaplacian, .passes = 10}}) {
        SCOPED_TRACE(name_of(smooth));
        expect_same_window(run(column(60), smoothed(smooth)).report.smoothing,
                           run(column(120), smoothed(smooth)).report.smoothing);
    }
    const SmoothOptions nifpms{.filter = SmoothFilter::kNifpms};
    expect_same_window(wall(60, nifpms), wall(120, nifpms));
}

TEST(Memory, more_passes_hold_as_many_more_strips) {
    const auto held = [](std::uint32_t passes) {
        return run(column(80), smoothed({.passes = passes})).report.smoothing.window_chunks;
    };
    EXPECT_LE(held(20) - held(10), 14u);
}

// The sampled box.

TEST(SampledBox, keeps_its_sides_to_the_bit_through_smoothing_and_decimation) {
    const Vec3 spacing{0.1, 0.7, 1.0 / 3};
    for (SmoothFilter filter : kVertexFilters)
        for (double share : {0.0, 0.8}) {
            ReconstructOptions options = test::reduced(share);
            options.smooth = {.filter = filter};
            const Reconstruction made = run(test::noise_volume({6, 7, 8}, 3, 9).spaced(spacing), options);
            test::expect_sound(made.report.check);
            const Vec3 high{5 * spacing.x, 6 * spacing.y, 7 * spacing.z};
            int corners = 0;
            test::for_vertices(made.mesh, [&](VertexId v) {
                const Vertex& vertex = made.mesh[v];
                for (int side = 0; side < 6; ++side) {
                    if (!(vertex.sides >> side & 1)) continue;
                    EXPECT_EQ(vertex.position[side / 2], side % 2 ? high[side / 2] : 0.0);
                }
                corners += std::popcount(vertex.sides) == 3;
            });
            EXPECT_EQ(corners, 8);
        }
}

// Oracle: what comes out is what the labels say, whatever the filter.

TEST(Oracle, smoothed_noise_is_sound) {
    for (SmoothFilter filter : kVertexFilters)
        for (std::uint32_t passes : {20u, 100u})
            for (std::uint32_t labels : {2, 4, 60}) {
                if (filter == SmoothFilter::kNifpms && passes == 100) continue;  // it makes one pass only
                SCOPED_TRACE(name_of({.filter = filter, .passes = passes}) + ", " + std::to_string(labels) + " labels");
                test::ArrayVolume volume = test::noise_volume({6, 6, 8}, labels, 7);
                const Reconstruction made = run(volume, smoothed({.filter = filter, .passes = passes}));
                test::expect_sound(made.report.check);
                EXPECT_GE(made.report.check.quality.min, 0.1);
                test::expect_generic(made.mesh);
                test::expect_same_strata(test::list_strata(made.mesh), test::list_strata(run(volume).mesh));
            }
}

TEST(Oracle, smoothed_grains_are_sound) {
    for (SmoothFilter filter : kVertexFilters)
        for (std::uint32_t passes : {20u, 100u}) {
            if (filter == SmoothFilter::kNifpms && passes == 100) continue;
            SCOPED_TRACE(name_of({.filter = filter, .passes = passes}));
            const Reconstruction made =
                run(test::grain_volume({14, 13, 12}, 8, 7), smoothed({.filter = filter, .passes = passes}));
            test::expect_sound(made.report.check);
            EXPECT_GE(made.report.check.quality.min, 0.1);
        }
}

TEST(Oracle, smoothed_and_decimated_is_sound) {
    for (SmoothFilter filter : kVertexFilters) {
        SCOPED_TRACE(name_of({.filter = filter}));
        ReconstructOptions options = test::reduced(0.9);
        options.smooth = {.filter = filter};
        test::expect_sound(run(test::noise_volume({7, 7, 7}, 3, 4), options).report.check);
        const Reconstruction made = run(test::grain_volume({14, 14, 14}, 5, 4), options);
        test::expect_sound(made.report.check);
        EXPECT_LE(made.report.final_faces, made.report.initial_faces / 10 + 1);
        options.background = {0, 1};
        test::expect_sound(run(test::noise_volume({7, 7, 7}, 4, 4), options).report.check);
        options.cap = false;
        test::expect_sound(run(test::noise_volume({7, 7, 7}, 4, 4), options).report.check);
    }
}

TEST(OnTheFly, smoothing_within_a_budget_that_binds_stays_sound) {
    for (SmoothFilter filter : kVertexFilters)
        for (const Sweep& sweep : {kSweepX, kSweepZ}) {
            if (filter == SmoothFilter::kNifpms && sweep.axes == kSweepX.axes) continue;  // slow
            SCOPED_TRACE(name_of({.filter = filter}));
            test::ArrayVolume volume = test::grain_blocks(12, 4);
            ReconstructOptions options{.target_faces = 1500, .smooth = {.filter = filter}, .background = {}};
            options.face_budget = 3000;
            const Reconstruction made = run(volume.swept(sweep), options);
            ASSERT_GT(made.report.initial_faces, 6000u) << "the budget does not bind";
            test::expect_sound(made.report.check);
            EXPECT_LE(made.report.final_faces, 1500u);
        }
}

TEST(OnTheFly, smoothed_noise_within_a_budget_stays_sound) {
    for (SmoothFilter filter : {SmoothFilter::kTaubin, SmoothFilter::kLaplacian}) {
        ReconstructOptions options{.target_faces = 700, .smooth = {.filter = filter, .passes = 60}, .background = {}};
        options.face_budget = 2000;
        test::expect_sound(run(test::noise_volume({6, 6, 24}, 3, 2), options).report.check);
        test::expect_sound(run(test::noise_volume({6, 6, 24}, 2, 2).once(), options).report.check);
    }
}

// Anisotropy.

TEST(Anisotropy, smoothing_at_any_spacing_is_sound) {
    for (const Vec3 spacing : {Vec3{1, 2, 5}, Vec3{5, 2, 1}, Vec3{1, 1, 0.2}, Vec3{1e-3, 2e-3, 5e-3}})
        for (SmoothFilter filter : kVertexFilters) {
            SCOPED_TRACE(name_of({.filter = filter}) + ", spacing " + std::to_string(spacing.x) + " " +
                         std::to_string(spacing.z));
            for (std::uint32_t passes : {20u, 100u}) {
                if (filter == SmoothFilter::kNifpms && passes == 100) continue;
                test::expect_sound(run(test::noise_volume({5, 5, 8}, 3, 1).spaced(spacing),
                                       smoothed({.filter = filter, .passes = passes}))
                                       .report.check);
            }
            test::expect_sound(
                run(test::grain_volume({8, 8, 10}, 5, 2).spaced(spacing), smoothed({.filter = filter})).report.check);
        }
}

TEST(Anisotropy, oblique_directions_move_the_smoothed_model_as_a_whole) {
    test::ArrayVolume volume = test::grain_volume({10, 10, 10}, 5, 2).spaced({1, 2, 3});
    const Reconstruction straight = run(volume, smoothed());
    volume.lattice().direction = {0, 0, 1, -1, 0, 0, 0, 1, 0};
    volume.lattice().origin = {10, 20, 30};
    const Reconstruction turned = run(volume, smoothed());
    test::expect_sound(turned.report.check);
    test::for_vertices(straight.mesh, [&](VertexId v) {
        const Vec3 p = straight.mesh.position(v);
        EXPECT_LT(length(turned.mesh.position(v) - Vec3{10 + p.z, 20 - p.x, 30 + p.y}), 1e-12);
    });
}

}  // namespace
}  // namespace regionmesh
