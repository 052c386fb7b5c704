#include "smooth/filters/backtrack.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "base/triangle.h"
#include "support/shapes.h"
#include "support/surface_windows.h"

namespace regionmesh {
namespace {

using Corners = std::array<Vec3, 3>;

/// Base from (0, 0, 0) to (1, 0, 0), apex at this height above its middle.
Corners triangle(double height) { return {Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0.5, height, 0}}; }
double quality(const Corners& t) { return face_quality(t[0], t[1], t[2]); }

/// Of a triangle with this quality, flatter than an equilateral one.
double height_of_quality(double wanted) {
    double low = 0, high = 0.8;
    for (int n = 0; n < 60; ++n) {
        const double middle = 0.5 * (low + high);
        (quality(triangle(middle)) < wanted ? low : high) = middle;
    }
    return high;
}

/// Vertices of a mesh, their smoothed positions, and rounds of backtracking.
struct Rounds {
    Rounds(const Mesh& mesh, const std::vector<Vec3>& places, const SmoothOptions& with = {.threads = 1})
        : window(test::window_of(mesh)), options(with), rounds(window, steps, options) {
        for (Vec3 p : places) {
            smooth.push_back(p);
            now.push_back(p);
        }
        steps.backtrack.grow(smooth.end());
        steps.wanted.grow(smooth.end());
        steps.smooth = &smooth;
        steps.now = &now;
    }
    ShapeFault fault_of(std::uint32_t f) const {
        Corners before, after;
        for (int n = 0; n < 3; ++n) {
            before[n] = window.origin[window.faces[f].vertices[n]];
            after[n] = now[window.faces[f].vertices[n]];
        }
        return shape_fault(before, after, options.min_quality);
    }

    SurfaceWindow window;
    SmoothOptions options;
    SlidingArray<Vec3> smooth, now;
    StepLengths steps;
    BacktrackRounds rounds;
};

/// The sheet, with vertex 0 gone this far along x; at 1 it meets its neighbour, beyond it has turned two faces over.
Rounds pushed(double x, const SmoothOptions& options = {.threads = 1}) {
    const Mesh mesh = test::edge_in_sheet();
    std::vector<Vec3> places;
    for (std::uint32_t v = 0; v < 10; ++v) places.push_back(mesh.position(VertexId{v}));
    places[0] = {x, 0, 0};
    return Rounds(mesh, places, options);
}

TEST(ShapeFault, a_face_that_turns_by_90_degrees_or_more_is_turned) {
    const Corners flat = triangle(0.8);
    const auto tilted = [&](double degrees) {
        const double angle = degrees * std::acos(-1.0) / 180;
        return Corners{flat[0], flat[1], Vec3{0.5, 0.8 * std::cos(angle), 0.8 * std::sin(angle)}};
    };
    EXPECT_EQ(shape_fault(flat, flat, 0.1), ShapeFault::kNone);
    EXPECT_EQ(shape_fault(flat, tilted(89), 0.1), ShapeFault::kNone);
    EXPECT_EQ(shape_fault(flat, tilted(91), 0.1), ShapeFault::kTurned);
    EXPECT_EQ(shape_fault(flat, tilted(180), 0.1), ShapeFault::kTurned);
    EXPECT_EQ(shape_fault(flat, {flat[0], flat[1], Vec3{0.5, 0, 0.8}}, 0.1), ShapeFault::kTurned) << "90 degrees";
    EXPECT_EQ(shape_fault(flat, {flat[0], flat[1], flat[0]}, 0.1), ShapeFault::kTurned) << "no normal at all";
}

TEST(ShapeFault, a_face_that_falls_below_the_bound_is_a_fault) {
    const double at_bound = height_of_quality(0.1);
    EXPECT_EQ(shape_fault(triangle(0.8), triangle(at_bound * 1.01), 0.1), ShapeFault::kNone);
    EXPECT_EQ(shape_fault(triangle(0.8), triangle(at_bound * 0.99), 0.1), ShapeFault::kQuality);
    EXPECT_EQ(shape_fault(triangle(at_bound * 1.01), triangle(at_bound * 0.99), 0.1), ShapeFault::kQuality);
}

TEST(ShapeFault, a_face_that_was_bad_may_lose_up_to_half) {
    const Corners bad = triangle(height_of_quality(0.05));
    EXPECT_EQ(shape_fault(bad, bad, 0.1), ShapeFault::kNone);
    EXPECT_EQ(shape_fault(bad, triangle(height_of_quality(0.09)), 0.1), ShapeFault::kNone) << "better, if not good";
    EXPECT_EQ(shape_fault(bad, triangle(height_of_quality(0.026)), 0.1), ShapeFault::kNone);
    EXPECT_EQ(shape_fault(bad, triangle(height_of_quality(0.024)), 0.1), ShapeFault::kQuality);
}

TEST(ShapeFault, without_a_bound_only_needles_are_faults) {
    EXPECT_EQ(shape_fault(triangle(0.8), triangle(height_of_quality(0.001)), 0), ShapeFault::kNone);
    EXPECT_EQ(shape_fault(triangle(0.8), triangle(1e-9), 0), ShapeFault::kQuality);
    EXPECT_EQ(shape_fault(triangle(0.8), triangle(-0.8), 0), ShapeFault::kTurned);
}

TEST(ShapeFault, does_not_depend_on_scale) {
    const double at_bound = height_of_quality(0.1);
    for (double scale : {1e-6, 1e6})
        for (double height : {0.99 * at_bound, 1.01 * at_bound, -0.5}) {
            const Corners before = triangle(0.8), after = triangle(height);
            Corners scaled_before, scaled_after;
            for (int n = 0; n < 3; ++n) {
                scaled_before[n] = scale * before[n];
                scaled_after[n] = scale * after[n];
            }
            EXPECT_EQ(shape_fault(scaled_before, scaled_after, 0.1), shape_fault(before, after, 0.1));
        }
}

TEST(PositionAt, goes_from_the_smoothed_position_to_the_origin) {
    const Vec3 origin{1.0 / 3, 0.1, -7}, smooth{0.7, 1e-3, 2};
    EXPECT_EQ(position_at(origin, smooth, 0), smooth);
    EXPECT_EQ(position_at(origin, smooth, kFullBacktrack), origin);
    EXPECT_EQ(position_at(origin, smooth, 200), origin);
    double last = 0;
    for (std::uint8_t steps = 1; steps <= kFullBacktrack; ++steps) {
        const double gone = length(position_at(origin, smooth, steps) - smooth);
        EXPECT_NEAR(gone, steps / 8.0 * length(origin - smooth), 1e-12);
        EXPECT_GT(gone, last);
        last = gone;
    }
}

TEST(StepLengths, move_a_vertex_as_far_as_it_backtracks) {
    Rounds sheet = pushed(0.8);
    sheet.steps.set_backtrack(sheet.window, 0, 4);
    EXPECT_EQ(sheet.steps.backtrack[0], 4);
    EXPECT_EQ(sheet.now[0], (Vec3{0.4, 0, 0}));
    sheet.steps.set_backtrack(sheet.window, 0, 11);
    EXPECT_EQ(sheet.steps.backtrack[0], kFullBacktrack);
    EXPECT_EQ(sheet.now[0], (Vec3{0, 0, 0}));
    EXPECT_EQ(sheet.smooth[0], (Vec3{0.8, 0, 0})) << "where smoothing took it is not forgotten";
}

TEST(Backtrack, nothing_moves_where_all_is_sound) {
    Rounds sheet = pushed(0.3);
    sheet.rounds.run(0, 0, true);
    EXPECT_EQ(sheet.rounds.faults().turned + sheet.rounds.faults().low_quality, 0u);
    for (std::uint32_t v = 0; v < 10; ++v) EXPECT_EQ(sheet.steps.backtrack[v], 0);
}

TEST(Backtrack, the_first_round_requests_the_fewest_valid_steps) {
    Rounds sheet = pushed(1.8);
    EXPECT_EQ(sheet.fault_of(0), ShapeFault::kTurned);
    sheet.rounds.run(0, 0, true);
    EXPECT_EQ(sheet.rounds.faults().turned, 2u);
    EXPECT_EQ(sheet.rounds.faults().low_quality, 0u);
    const std::uint8_t needed = sheet.steps.backtrack[0];
    for (std::uint32_t f : {0u, 1u}) EXPECT_EQ(sheet.fault_of(f), ShapeFault::kNone);
    for (std::uint32_t v : {1u, 2u, 3u})
        EXPECT_EQ(sheet.steps.backtrack[v], needed) << "all corners of the faulty faces backtrack";
    EXPECT_EQ(sheet.steps.backtrack[5], 0);
    ASSERT_GT(needed, 1);
    sheet.steps.set_backtrack(sheet.window, 0, needed - 1);
    EXPECT_NE(sheet.fault_of(0), ShapeFault::kNone) << "one step less is not enough";
}

TEST(Backtrack, low_quality_is_counted_apart) {
    Rounds sheet = pushed(0.95);
    ASSERT_EQ(sheet.fault_of(0), ShapeFault::kQuality);
    sheet.rounds.run(0, 0, true);
    EXPECT_EQ(sheet.rounds.faults().turned, 0u);
    EXPECT_EQ(sheet.rounds.faults().low_quality, 2u);
    EXPECT_EQ(sheet.fault_of(0), ShapeFault::kNone);
}

TEST(Backtrack, later_rounds_ask_for_two_more_and_count_nothing) {
    Rounds sheet = pushed(1.8);
    for (std::uint32_t v : {1u, 2u, 3u}) sheet.steps.backtrack[v] = 5;
    sheet.rounds.run(1, 0, true);
    EXPECT_EQ(sheet.steps.backtrack[0], 2);
    EXPECT_EQ(sheet.steps.backtrack[1], 7);
    EXPECT_EQ(sheet.steps.backtrack[5], 0);
    sheet.rounds.run(2, 0, true);
    EXPECT_EQ(sheet.steps.backtrack[0], 4);
    EXPECT_EQ(sheet.steps.backtrack[1], kFullBacktrack);
    EXPECT_EQ(sheet.rounds.faults().turned, 0u);
}

TEST(Backtrack, a_vertex_follows_the_face_that_asks_for_most) {
    // Vertex 0 is shared by a face that needs many steps and one that needs few.
    const Mesh mesh =
        test::shape({{0, 0, 0}, {1, 0.5, 0}, {1, -0.5, 0}, {-1, -0.5, 0}, {-1, 0.5, 0}}, {{{0, 2, 1}}, {{0, 4, 3}}});
    Rounds both(mesh, {{0, 0, 0}, {-4, 0.5, 0}, {-4, -0.5, 0}, {0.2, -0.5, 0}, {0.2, 0.5, 0}});
    ASSERT_EQ(both.fault_of(0), ShapeFault::kTurned);
    ASSERT_EQ(both.fault_of(1), ShapeFault::kTurned);
    both.rounds.run(0, 0, true);
    EXPECT_GT(both.steps.backtrack[1], both.steps.backtrack[3]);
    EXPECT_EQ(both.steps.backtrack[0], both.steps.backtrack[1]);
}

TEST(Backtrack, in_chunks_gives_the_same_as_in_one_chunk) {
    // Two faces with a common edge, the second in a chunk of its own with one new vertex; both turn over.
    const std::vector<ChunkVertex> from{{{0, 0, 0}}, {{1, 0, 0}}, {{0, 1, 0}}, {{1, 1, 0}}};
    const std::vector<Vec3> to{{0, 0, 0}, {1, 0, 0}, {0, -0.3, 0}, {1, -1.5, 0}};
    const Chunk whole{
        .carried = 0, .vertices = from, .faces = {{{0, 1, 2}, {0, 1}}, {{1, 3, 2}, {0, 1}}}, .active = {}};
    const Chunk first{
        .carried = 0, .vertices = {from[0], from[1], from[2]}, .faces = {{{0, 1, 2}, {0, 1}}}, .active = {1, 2}};
    const Chunk second{.carried = 2, .vertices = {from[3]}, .faces = {{{0, 2, 1}, {0, 1}}}, .active = {}};
    std::vector<std::uint8_t> steps_of[2];
    for (bool is_cut : {false, true}) {
        SurfaceWindow window;
        window.add(is_cut ? first : whole);
        if (is_cut) window.add(second);
        SlidingArray<Vec3> smooth, now;
        for (Vec3 p : to) {
            smooth.push_back(p);
            now.push_back(p);
        }
        StepLengths steps;
        steps.backtrack.grow(4);
        steps.wanted.grow(4);
        steps.smooth = &smooth;
        steps.now = &now;
        const SmoothOptions options{.threads = 1};
        BacktrackRounds rounds(window, steps, options);
        // A round on chunk n follows the round before on chunk n + 1.
        if (is_cut)
            for (const auto& [round, chunk] : {std::pair{0u, 0u}, {0u, 1u}, {1u, 0u}, {1u, 1u}, {2u, 0u}, {2u, 1u}})
                rounds.run(round, chunk, chunk == 1);
        else
            for (std::uint32_t round = 0; round < 3; ++round) rounds.run(round, 0, true);
        EXPECT_EQ(rounds.faults().turned, 2u);
        for (std::uint32_t v = 0; v < 4; ++v) steps_of[is_cut].push_back(steps.backtrack[v]);
    }
    EXPECT_EQ(steps_of[0], steps_of[1]);
    EXPECT_GT(steps_of[0][3], 0);
    EXPECT_GE(steps_of[0][1], steps_of[0][0]);
}

}  // namespace
}  // namespace regionmesh
