#include "regionmesh/decimate/decimate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "regionmesh/base/triangle.h"
#include "support/digest.h"
#include "support/runs.h"
#include "support/shapes.h"

namespace regionmesh {
namespace {

using test::run;

std::uint64_t count(const DecimateResult& result, Verdict verdict) { return result.verdicts[static_cast<int>(verdict)]; }

Model noise() { return run(test::noise_volume({8, 8, 8}, 3, 5)).model; }
Model grains() { return run(test::grain_volume({12, 12, 12}, 8, 5)).model; }

/// The sheet with only its middle edge free.
Model sheet_with_fixed_rim() {
    Model model = test::edge_in_sheet();
    for (std::uint32_t v = 2; v < model.vertex_end(); ++v) model[VertexId{v}].is_fixed = true;
    return model;
}

double volume_of(const Model& model, Label label) {
    double volume = 0;
    for (const RegionReport& region : check(model).regions)
        if (region.label == label) volume = region.volume;
    return volume;
}

TEST(Decimate, a_box_of_one_label_goes_down_to_twelve_faces) {
    Model model = run(test::solid_volume({7, 6, 5})).model;
    const DecimateResult done = decimate(model, {});
    EXPECT_EQ(model.face_count(), 12u);
    EXPECT_EQ(model.vertex_count(), 8u);
    EXPECT_EQ(done.stopped, StopReason::kTopology);
    EXPECT_EQ(volume_of(model, 0), 6 * 5 * 4);
    test::expect_sound(check(model));
}

TEST(Decimate, does_nothing_at_the_target) {
    Model model = noise();
    const std::uint64_t before = test::digest(model);
    EXPECT_EQ(decimate(model, {.target_faces = model.face_count()}).stopped, StopReason::kTarget);
    EXPECT_EQ(test::digest(model), before);
}

TEST(Decimate, stops_at_the_target) {
    Model model = grains();
    const std::uint32_t target = model.face_count() / 3;
    EXPECT_EQ(decimate(model, {.target_faces = target}).stopped, StopReason::kTarget);
    EXPECT_LE(model.face_count(), target);
    EXPECT_GE(model.face_count(), target - 6) << "one collapse takes a few faces";
}

TEST(Decimate, one_free_edge_is_collapsed_once) {
    Model model = sheet_with_fixed_rim();
    const DecimateResult done = decimate(model, {});
    EXPECT_EQ(count(done, Verdict::kAccepted), 1u);
    EXPECT_EQ(done.verdicts, (VerdictCounts{1}));
    EXPECT_EQ(model.face_count(), 8u);
}

TEST(Decimate, counts_a_link_verdict) {
    Model model = test::shape(test::kTetrahedronCorners, test::tetrahedron_faces());
    const DecimateResult done = decimate(model, {});
    EXPECT_EQ(done.verdicts, (VerdictCounts{0, 0, 6}));
    EXPECT_EQ(done.stopped, StopReason::kTopology);
    EXPECT_EQ(model.face_count(), 4u);
}

TEST(Decimate, counts_edges_that_strata_forbid) {
    Model model = run(test::solid_volume({2, 2, 2})).model;
    const DecimateResult done = decimate(model, {});
    EXPECT_EQ(done.verdicts, (VerdictCounts{0, 18})) << "twelve edges and six diagonals between eight points";
}

TEST(Decimate, counts_a_quality_verdict) {
    Model model = sheet_with_fixed_rim();
    model[VertexId{2}].position.y = 0.1;
    model[VertexId{3}].position.y = -0.1;
    const DecimateResult done = decimate(model, {.min_quality = 0.2});
    EXPECT_EQ(done.verdicts, (VerdictCounts{0, 0, 0, 0, 1}));
}

/// The sheet as a pyramid frustum: its middle edge lies at this height, and would go up to the tip.
Model frustum(double height) {
    Model model = sheet_with_fixed_rim();
    for (std::uint32_t v : {0u, 1u}) model[VertexId{v}].position.z = height;
    return model;
}

TEST(Decimate, counts_an_intersect_verdict) {
    Model free = frustum(0.5);
    EXPECT_EQ(decimate(free, {.min_quality = 0}).verdicts, (VerdictCounts{1}));
    const Vec3 tip = free.position(VertexId{free.is_alive(VertexId{0}) ? 0u : 1u});
    // A thin face where the tip would be.
    Model model = frustum(0.5);
    test::add_shape(model, {tip + Vec3{0, 0, -0.01}, tip + Vec3{0.01, 0, 0.1}, tip + Vec3{-0.01, 0.01, 0.1}}, {{{0, 1, 2}, 1, 2}});
    for (std::uint32_t v = 10; v < 13; ++v) model[VertexId{v}].is_fixed = true;
    Model unchecked = frustum(0.5);
    test::add_shape(unchecked, {tip + Vec3{0, 0, -0.01}, tip + Vec3{0.01, 0, 0.1}, tip + Vec3{-0.01, 0.01, 0.1}}, {{{0, 1, 2}, 1, 2}});
    for (std::uint32_t v = 10; v < 13; ++v) unchecked[VertexId{v}].is_fixed = true;
    EXPECT_EQ(decimate(model, {.min_quality = 0}).verdicts, (VerdictCounts{0, 0, 0, 0, 0, 0, 1}));
    EXPECT_EQ(decimate(unchecked, {.min_quality = 0, .intersect_check = false}).verdicts, (VerdictCounts{1}));
}

TEST(Decimate, noise_meets_every_verdict) {
    Model model = noise();
    const DecimateResult done = decimate(model, {});
    for (int n = 0; n < kVerdictCount; ++n) EXPECT_GT(done.verdicts[n], 0u) << kVerdictNames[n];
}

TEST(Decimate, fixed_vertices_stay) {
    Model model = grains();
    model.sort_spatially();
    std::map<std::uint32_t, Vec3> fixed;
    for (std::uint32_t v = 0; v < model.vertex_end(); v += 7) {
        model[VertexId{v}].is_fixed = true;
        fixed[v] = model.position(VertexId{v});
    }
    decimate(model, {.target_faces = model.face_count() / 2});
    for (const auto& [v, position] : fixed) {
        EXPECT_TRUE(model.is_alive(VertexId{v}));
        EXPECT_EQ(model.position(VertexId{v}), position);
    }
    test::expect_sound(check(model));
}

TEST(Decimate, faces_that_reach_beyond_the_limits_stay) {
    Model model = run(test::ball_volume({14, 14, 14}, 5)).model;
    DecimateOptions options;
    options.limits.high = {7.3, 9.1, HUGE_VAL};
    const auto faces_beyond = [&] {
        std::set<std::array<double, 9>> faces;
        test::for_faces(model, [&](FaceId f) {
            std::array<double, 9> place;
            bool reaches_out = false;
            for (int n = 0; n < 3; ++n) {
                const Vec3 p = model.corners(f)[n];
                reaches_out |= p.x > 7.3 || p.y > 9.1;
                for (int axis = 0; axis < 3; ++axis) place[3 * n + axis] = p[axis];
            }
            if (reaches_out) faces.insert(place);
        });
        return faces;
    };
    const auto before = faces_beyond();
    const std::uint32_t count_before = model.face_count();
    decimate(model, options);
    EXPECT_EQ(faces_beyond(), before);
    EXPECT_LT(model.face_count(), count_before * 0.8);
    test::for_vertices(model, [&](VertexId v) { EXPECT_FALSE(model[v].is_fixed); });
    test::expect_sound(check(model));
}

TEST(Decimate, merged_vertices_stay_within_the_limits) {
    Model model = run(test::grain_volume({10, 10, 10}, 5, 3)).model;
    std::set<std::array<double, 3>> before;
    const auto key = [&](VertexId v) { return std::array{model.position(v).x, model.position(v).y, model.position(v).z}; };
    test::for_vertices(model, [&](VertexId v) { before.insert(key(v)); });
    DecimateOptions options;
    options.limits.high.z = 4;
    decimate(model, options);
    std::uint32_t beyond = 0;
    test::for_vertices(model, [&](VertexId v) {
        if (model.position(v).z < 4 || (model[v].sides & 0x30)) return;
        ++beyond;
        EXPECT_TRUE(before.contains(key(v)));
    });
    EXPECT_GT(beyond, 0u);
    test::expect_sound(check(model));
}

TEST(Decimate, at_cost_level_zero_only_flat_parts_go) {
    Model model = run(test::TextVolume({{"1111", "1111", "1111"}, {"1111", "1221", "1111"}, {"1111", "1111", "1111"}})).model;
    const CheckReport before = check(model);
    const std::uint32_t faces = model.face_count();
    decimate(model, {.max_cost = 1e-12});
    const CheckReport after = check(model);
    EXPECT_LT(model.face_count(), faces);
    for (std::size_t n = 0; n < before.regions.size(); ++n) EXPECT_NEAR(after.regions[n].volume, before.regions[n].volume, 1e-5);
}

TEST(Decimate, a_higher_cost_level_or_error_leaves_fewer_faces) {
    std::uint32_t last = ~0u;
    for (double cost : {1e-9, 1e-3, 1e-1}) {
        Model model = grains();
        decimate(model, {.max_cost = cost});
        EXPECT_LT(model.face_count(), last);
        last = model.face_count();
    }
    last = ~0u;
    for (double error : {1e-6, 0.05, 0.3}) {
        Model model = grains();
        EXPECT_EQ(decimate(model, {.max_error = error}).stopped, StopReason::kMaxError);
        EXPECT_LT(model.face_count(), last);
        last = model.face_count();
    }
}

TEST(Decimate, a_small_error_keeps_a_ball_round) {
    Model model = run(test::ball_volume({20, 20, 20}, 7)).model;
    const double before = volume_of(model, 1);
    const std::uint32_t faces = model.face_count();
    decimate(model, {.max_error = 0.2});
    EXPECT_LT(model.face_count(), faces / 2);
    EXPECT_NEAR(volume_of(model, 1), before, 0.03 * before);
    test::for_faces(model, [&](FaceId f) {
        if (is_exterior(model[f].labels[1])) return;
        for (Vec3 p : model.corners(f)) EXPECT_NEAR(length(p - Vec3{9.5, 9.5, 9.5}), 7, 1.5);
    });
}

TEST(Decimate, a_ball_that_outgrows_its_first_box_meets_no_face_that_is_not_there) {
    Model model = run(test::ball_volume({10, 10, 10}, 4.325), {.decimate = false}).model;
    model.sort_spatially();
    decimate(model, {.min_quality = 0, .perturbation = 0.9});
    test::expect_sound(check(model));
}

TEST(Decimate, the_same_run_twice_gives_the_same_bytes) {
    for (double perturbation : {0.0, 1e-7, 1e-2}) {
        Model first = noise(), second = noise();
        decimate(first, {.target_faces = 2000, .perturbation = perturbation});
        decimate(second, {.target_faces = 2000, .perturbation = perturbation});
        EXPECT_EQ(test::digest(first), test::digest(second));
    }
}

TEST(Decimate, keeps_every_face_above_the_quality_floor) {
    for (double floor : {0.0, 0.05, 0.1, 0.13}) {
        Model model = noise();
        decimate(model, {.min_quality = floor});
        EXPECT_GE(check(model).quality.min, floor);
        test::expect_sound(check(model));
    }
}

TEST(Decimate, vertices_on_box_sides_keep_that_coordinate_to_the_bit) {
    Model model = run(test::noise_volume({6, 7, 8}, 3, 9).spaced({0.1, 0.7, 1.0 / 3})).model;
    const Vec3 high{5 * 0.1, 6 * 0.7, 7 * (1.0 / 3)};
    decimate(model, {.scale = 0.3});
    test::for_vertices(model, [&](VertexId v) {
        for (int side = 0; side < 6; ++side) {
            if (!(model[v].sides >> side & 1)) continue;
            EXPECT_EQ(model.position(v)[side / 2], side % 2 ? high[side / 2] : 0.0);
        }
    });
}

TEST(Decimate, reports_progress) {
    Model model = grains();
    int calls = 0;
    DecimateOptions options;
    options.on_progress = [&] { ++calls; };
    const std::uint32_t before = model.face_count();
    decimate(model, options);
    EXPECT_GT(calls, 0);
    EXPECT_LT(static_cast<std::uint32_t>(calls), before / 10) << "now and then";
}

}  // namespace
}  // namespace regionmesh
