#include "smooth/lattice/lattice_quadric.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>

#include "smooth/lattice/lattice_lines.h"
#include "smooth/lattice/lattice_simplex.h"

namespace regionmesh {
namespace {

/// Of u and v: q[0] + q[1] u + q[2] v + q[3] u^2 + q[4] u v + q[5] v^2.
using PlaneHeights = std::array<float, 6>;

float height_of(const PlaneHeights& q, float u, float v) {
    return q[0] + q[1] * u + q[2] * v + q[3] * u * u + q[4] * u * v + q[5] * v * v;
}

/// Four samples that do not count, in simplices of kind 1.
HeightSamples::Four weightless() {
    HeightSamples::Four four{};
    four.kind.fill(1);
    return four;
}

/// On a square of `side` x `side` points, `step` apart, round the centre.
HeightSamples samples_of(const PlaneHeights& q, int side, float step) {
    HeightSamples samples;
    int count = 0;
    for (int i = 0; i < side; ++i)
        for (int j = 0; j < side; ++j, ++count) {
            const int lane = count % 4;
            if (lane == 0) samples.fours.push_back(weightless());
            HeightSamples::Four& four = samples.fours.back();
            const float u = step * (static_cast<float>(i) - 0.5f * static_cast<float>(side - 1)),
                        v = step * (static_cast<float>(j) - 0.5f * static_cast<float>(side - 1));
            four.u[lane] = u;
            four.v[lane] = v;
            four.height[lane] = height_of(q, u, v);
            four.weight[lane] = 1;
            four.kind[static_cast<std::size_t>(lane)] = static_cast<std::uint8_t>(1 + count % (kFirstTriangle - 1));
        }
    samples.count = static_cast<std::uint32_t>(samples.fours.size());
    return samples;
}

Float3 at_frame(const TangentFrame& frame, float u, float v, float height) {
    return u * frame.u + v * frame.v + height * frame.normal;
}

const PlaneHeights kShapes[] = {
    {0.3f, 0, 0, 0, 0, 0},                       // level
    {0.1f, 0.4f, -0.3f, 0, 0, 0},                // oblique
    {0, 0, 0, 0.05f, 0, 0.05f},                  // bowl
    {-0.2f, 0.1f, 0.2f, 0.06f, -0.04f, -0.05f},  // saddle
};
const Float3 kNormals[] = {{0, 0, 1}, {1, 0, 0}, {0.6f, 0, 0.8f}, {1 / 3.0f, -2 / 3.0f, 2 / 3.0f}};

TEST(HeightQuadric, is_the_paraboloid_that_its_samples_lie_on) {
    for (const Float3 normal : kNormals)
        for (const PlaneHeights& q : kShapes) {
            const TangentFrame frame(normal);
            HeightQuadric quadric;
            quadric.normal = normal;
            ASSERT_TRUE(quadric.fit(samples_of(q, 8, 0.75f), frame, {1, 1, 1}, 3, 2, 0.3f));
            for (const float u : {-1.5f, 0.0f, 1.0f})
                for (const float v : {-1.0f, 0.5f, 2.0f}) {
                    const float height = height_of(q, u, v);
                    const auto on = quadric.at(all_four(at_frame(frame, u, v, height)));
                    EXPECT_NEAR(on.height[0], 0, 2e-3);
                    // Half a spacing above it, along the normal of the plane.
                    const auto above = quadric.at(all_four(at_frame(frame, u, v, height + 0.5f)));
                    EXPECT_NEAR(above.height[0], 0.5, 2e-3);
                    // The gradient is square to the surface: its parts along u and v are the slopes, turned round.
                    const Float3 gradient{on.gradient.x[0], on.gradient.y[0], on.gradient.z[0]};
                    EXPECT_NEAR(dot(gradient, frame.normal), 1, 2e-3);
                    EXPECT_NEAR(dot(gradient, frame.u), -(q[1] + 2 * q[3] * u + q[4] * v), 3e-3);
                    EXPECT_NEAR(dot(gradient, frame.v), -(q[2] + q[4] * u + 2 * q[5] * v), 3e-3);
                }
            const double bend = std::sqrt(4 * q[3] * q[3] + 2 * q[4] * q[4] + 4 * q[5] * q[5]);
            EXPECT_NEAR(quadric.curvedness(), bend, 2e-3);
        }
}

TEST(HeightQuadric, follows_samples_of_more_weight) {
    HeightSamples samples = samples_of({0, 0, 0, 0, 0, 0}, 8, 0.75f);
    for (std::size_t n = 0; n < samples.fours.size(); n += 2) samples.fours[n].height = all_four(1);
    const auto constant = [&](float weight) {
        for (std::size_t n = 0; n < samples.fours.size(); n += 2) samples.fours[n].weight = all_four(weight);
        HeightQuadric quadric;
        EXPECT_TRUE(quadric.fit(samples, TangentFrame({0, 0, 1}), {1, 1, 1}, 3, 1, 0.3f));
        return -quadric.constant;
    };
    EXPECT_NEAR(constant(0), 0, 1e-4);
    EXPECT_GT(constant(1), 0.3);
    EXPECT_LT(constant(1), 0.7);
    EXPECT_GT(constant(100), 0.8);
    EXPECT_GT(constant(10000), constant(100));
}

TEST(HeightQuadric, of_two_samples_is_level) {
    HeightSamples samples;
    samples.fours.push_back(HeightSamples::Four{.u = Float4{-1, 1, 0, 0},
                                                .v = Float4{},
                                                .height = Float4{0.2f, 0.6f, 0, 0},
                                                .weight = Float4{1, 1, 0, 0},
                                                .kind = Kinds4{1, 1, 1, 1}});
    samples.count = 1;
    HeightQuadric quadric;
    ASSERT_TRUE(quadric.fit(samples, TangentFrame({0, 0, 1}), {1, 1, 1}, 3, 2, 0.3f));
    EXPECT_LT(quadric.curvedness(), 0.05);
    EXPECT_NEAR(quadric.at(all_four(Float3{0, 0, 0.4f})).height[0], 0, 0.1);
}

TEST(HeightQuadric, cannot_be_fitted_to_nothing) {
    HeightSamples samples;
    samples.fours.push_back(weightless());
    samples.count = 1;
    EXPECT_FALSE(HeightQuadric().fit(samples, TangentFrame({0, 0, 1}), {1, 1, 1}, 3, 1, 0.3f));
}

TEST(StepVectors, reach_the_nodes_of_simplices) {
    const StepVectors steps(Float3{1, 2, 5});
    for (int kind = 1; kind < kKindCount; ++kind) {
        const auto k = static_cast<std::uint8_t>(kind);
        for (int n = 1; n < kKinds[k].node_count; ++n) {
            const Lanes3<Float4> to = steps.to_node({k, k, k, k}, n);
            const Step step = kKinds[k].steps[static_cast<std::size_t>(n)];
            EXPECT_EQ(to.x[2], step & 1 ? 1 : 0);
            EXPECT_EQ(to.y[1], step & 2 ? 2 : 0);
            EXPECT_EQ(to.z[3], step & 4 ? 5 : 0);
        }
    }
}

TEST(LatticeSteps, measure_exactly_far_from_the_origin) {
    const LatticeSteps steps({1, 0.3, 7});
    const LatticePoint far{{3'000'000'000, 2'000'000'001, 5}};
    const Float3 offset{0.25f, -0.125f, 2};
    const LatticePoint moved = steps.moved(far, offset);
    const Float3 back = steps.between(far, moved);
    EXPECT_NEAR(back.x, offset.x, steps.size(0));
    EXPECT_NEAR(back.y, offset.y, steps.size(1));
    EXPECT_NEAR(back.z, offset.z, steps.size(2));
    EXPECT_EQ(steps.moved(moved, {0, 0, 0}).at, moved.at);
}

/// The vertex of a simplex where it meets a plane of unit normal at this height over its centroid.
std::array<double, 3> meeting(const NearestPoint& point, int kind, Vec3 normal, double height) {
    NearestPoint own = point;
    own.add({.height = static_cast<float>(height), .slope = Float3(normal)}, edges_of(kind, {1, 1, 1}));
    return own.solve();
}

TEST(NearestPoint, lies_on_the_interface) {
    for (int kind = 1; kind < kKindCount; ++kind) {
        const SimplexEdges edges = edges_of(kind, {1, 1, 1});
        NearestPoint point{.count = edges.count};
        const Vec3 normal{0.6, 0.48, 0.64};
        const auto steps = meeting(point, kind, normal, 0.05);
        Vec3 moved;
        for (int n = 0; n < edges.count; ++n)
            moved = moved + edges.edges[static_cast<std::size_t>(n)] * steps[static_cast<std::size_t>(n)];
        EXPECT_NEAR(dot(moved, normal), -0.05, 1e-3) << kind;
    }
}

TEST(NearestPoint, stays_where_there_is_nothing_to_go_by) {
    EXPECT_EQ((NearestPoint{.count = 3}.solve()), (std::array<double, 3>{}));
}

TEST(NearestPoint, is_drawn_to_a_target_by_its_weight) {
    const SimplexEdges edges = edges_of(kind_of(1), {1, 1, 1});
    const Vec3 along = edges.edges[0];
    NearestPoint point{.count = 1};
    point.add({.height = 0, .slope = Float3(1, 0, 0)}, edges);
    point.add(along * 0.4, 1, edges);
    EXPECT_NEAR(point.solve()[0], 0.2, 1e-6);
    point.add(along * 0.4, 8, edges);
    EXPECT_NEAR(point.solve()[0], 0.36, 1e-6);
    EXPECT_NEAR(point.inverse()[0][0] * point.b[0], point.solve()[0], 1e-12);
}

TEST(NearestPoint, weights_of_a_step_sum_to_one) {
    for (int count = 1; count <= 3; ++count) {
        const Barycentric weights = weights_of({0.1, -0.2, 0.05}, count);
        double sum = 0;
        for (const double weight : weights) sum += weight;
        EXPECT_NEAR(sum, 1, 1e-12);
        EXPECT_NEAR(weights[1], 1.0 / (count + 1) + 0.1, 1e-12);
    }
}

}  // namespace
}  // namespace regionmesh
