#include "cells/ranked_tetrahedra.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "base/exact_predicates.h"
#include "regionmesh/error.h"
#include "support/meshes.h"

namespace regionmesh {
namespace {

using test::ArrayMesh;
using testing::ElementsAre;
using testing::HasSubstr;

const std::vector<Vec3> kCorners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

struct Ranked {
    LabelTable labels;
    RankedTetrahedra all;
    std::vector<RankedTetrahedron> tetrahedra;
};

Ranked rank(ArrayMesh mesh, const RankOptions& options = {.sweep = kSweepZ}) {
    LabelTable labels;
    RankedTetrahedra all = rank_tetrahedra(mesh, labels, options);
    std::vector<RankedTetrahedron> tetrahedra;
    for (RankedTetrahedron t; all.sorted.next(t);) tetrahedra.push_back(t);
    return {std::move(labels), std::move(all), std::move(tetrahedra)};
}

std::string refusal(ArrayMesh mesh, const RankOptions& options = {}) {
    try {
        rank(std::move(mesh), options);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::kInput);
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
        return error.what();
    }
    return "nothing thrown";
}

TEST(RankedTetrahedra, points_are_ranked_along_the_sweep_then_along_its_slow_and_fast_axes) {
    const ArrayMesh mesh = test::bent_mesh({4, 5, 3}, 3, 1).shuffled(2);
    for (const Sweep& sweep : {kSweepX, kSweepY, kSweepZ})
        for (const ArrayMesh& given : {mesh, test::mesh_of(test::grain_volume({4, 5, 3}, 3, 1)).shuffled(3)}) {
            const Ranked ranked = rank(given, {.sweep = sweep});
            const RankedPoints& points = ranked.all.points;
            ASSERT_EQ(points.size(), 60u);
            const auto key = [&](std::uint32_t r) {
                const Vec3 p = points.positions[r];
                return std::array{p[sweep.axes[2]], p[sweep.axes[1]], p[sweep.axes[0]]};
            };
            for (std::uint32_t r = 0; r < points.size(); ++r) {
                EXPECT_TRUE(r == 0 || key(r - 1) < key(r));
                EXPECT_EQ(points.along(r), key(r)[0]);
                EXPECT_EQ(points.positions[r], given.points().positions[points.points[r]]);
                EXPECT_EQ(ranked.labels.input(points.labels[r]), given.points().labels[points.points[r]]);
            }
            EXPECT_EQ(points.labels[0], 0u) << "labels get their numbers in the order of ranks";
        }
}

TEST(RankedTetrahedra, sweep_goes_along_the_longest_side_unless_told) {
    const std::array<Sweep, 3> sweeps{kSweepX, kSweepY, kSweepZ};
    for (int axis = 0; axis < 3; ++axis) {
        std::vector<Vec3> points = kCorners;
        for (Vec3& p : points) p[axis] *= 1.5;
        const ArrayMesh mesh{{points, {0, 0, 0, 0}}, {{{0, 1, 2, 3}}}};
        EXPECT_EQ(rank(mesh, {}).all.points.sweep.axes, sweeps[axis].axes);
        EXPECT_EQ(rank(mesh, {.sweep = kSweepY}).all.points.sweep.axes, kSweepY.axes);
    }
    EXPECT_EQ(rank({{kCorners, {0, 0, 0, 0}}, {{{0, 1, 2, 3}}}}, {}).all.points.sweep.axes, kSweepZ.axes);
}

TEST(RankedTetrahedra, tetrahedra_come_in_the_order_of_their_ranks_and_are_those_given) {
    const ArrayMesh mesh = test::bent_mesh({5, 4, 6}, 4, 7).shuffled(8);
    const Ranked ranked = rank(mesh);
    EXPECT_EQ(ranked.tetrahedra.size(), mesh.tetrahedra().size());
    std::vector<std::array<std::uint32_t, 4>> found, given;
    for (const RankedTetrahedron& t : ranked.tetrahedra) {
        EXPECT_TRUE(std::is_sorted(t.corners.begin(), t.corners.end()));
        EXPECT_TRUE(found.empty() || !(t < ranked.tetrahedra[found.size() - 1]));
        auto& corners = found.emplace_back();
        for (int n = 0; n < 4; ++n) corners[n] = ranked.all.points.points[t.corners[n]];
        std::sort(corners.begin(), corners.end());
    }
    for (const LabelledTetrahedron& t : mesh.tetrahedra()) {
        given.push_back(t.corners);
        std::sort(given.back().begin(), given.back().end());
    }
    EXPECT_THAT(found, testing::UnorderedElementsAreArray(given));
}

TEST(RankedTetrahedra, orientation_is_that_of_the_corners_in_the_order_of_ranks) {
    for (const ArrayMesh& mesh : {test::bent_mesh({4, 4, 4}, 2, 3), test::bent_mesh({4, 4, 4}, 2, 3).shuffled(5)}) {
        const Ranked ranked = rank(mesh);
        int mirrored = 0;
        for (const RankedTetrahedron& t : ranked.tetrahedra) {
            const auto& p = ranked.all.points.positions;
            EXPECT_EQ(bool(t.is_mirrored),
                      orientation(p[t.corners[0]], p[t.corners[1]], p[t.corners[2]], p[t.corners[3]]) < 0);
            mirrored += t.is_mirrored;
        }
        EXPECT_GT(mirrored, 0);
        EXPECT_LT(mirrored, static_cast<int>(ranked.tetrahedra.size()));
    }
}

TEST(RankedTetrahedra, labels_of_tetrahedra_go_with_them) {
    const test::ArrayVolume volume = test::noise_volume({4, 3, 5}, 6, 4, -3);
    const ArrayMesh mesh = test::cell_mesh_of(volume).shuffled(1);
    const Ranked ranked = rank(mesh);
    EXPECT_TRUE(ranked.all.points.labels.empty());
    std::map<std::array<std::uint32_t, 4>, InputLabel> label_of;
    for (const LabelledTetrahedron& t : mesh.tetrahedra()) {
        auto corners = t.corners;
        std::sort(corners.begin(), corners.end());
        label_of[corners] = t.label;
    }
    for (const RankedTetrahedron& t : ranked.tetrahedra) {
        std::array<std::uint32_t, 4> corners;
        for (int n = 0; n < 4; ++n) corners[n] = ranked.all.points.points[t.corners[n]];
        std::sort(corners.begin(), corners.end());
        EXPECT_EQ(ranked.labels.input(t.label), label_of.at(corners));
    }
}

TEST(RankedTetrahedra, points_at_one_place_with_one_label_are_one) {
    std::vector<Vec3> points = kCorners;
    points.push_back(points[3]);
    points.push_back({1, 1, 1});
    const Ranked ranked = rank({{points, {4, 5, 6, 7, 7, 8}}, {{{0, 1, 2, 3}}, {{1, 4, 2, 5}}}});
    EXPECT_EQ(ranked.all.points.size(), 5u);
    EXPECT_THAT(ranked.all.points.points, ElementsAre(0, 1, 2, 3, 5)) << "of several the first";
    ASSERT_EQ(ranked.tetrahedra.size(), 2u);
    EXPECT_THAT(ranked.tetrahedra[1].corners, ElementsAre(1, 2, 3, 4));
}

TEST(RankedTetrahedra, points_at_one_place_with_two_labels_are_named) {
    std::vector<Vec3> points = kCorners;
    points.push_back(points[2]);
    const std::string said = refusal({{points, {4, 5, 6, 7, -8}}, {{{0, 1, 2, 3}}}});
    for (const char* part : {"mesh: ", "node 2", "node 4", " 6", " -8"}) EXPECT_THAT(said, HasSubstr(part));
    // A third one differs from those before.
    points.push_back(points[2]);
    EXPECT_THAT(refusal({{points, {4, 5, 6, 7, 6, 9}}, {{{0, 1, 2, 3}}}}), HasSubstr("node 5"));
}

TEST(RankedTetrahedra, points_at_one_place_are_one_where_tetrahedra_have_the_labels) {
    std::vector<Vec3> points = kCorners;
    points.push_back(points[3]);
    points.push_back({1, 1, 1});
    const Ranked ranked = rank({{points, {}}, {{{0, 1, 2, 3}, 1}, {{1, 4, 2, 5}, 2}}});
    EXPECT_EQ(ranked.all.points.size(), 5u);
}

TEST(RankedTetrahedra, minus_zero_is_zero) {
    std::vector<Vec3> points = kCorners;
    points.push_back({-0.0, -0.0, 1});
    points.push_back({1, 1, 1});
    const Ranked ranked = rank({{points, {4, 5, 6, 7, 7, 8}}, {{{0, 1, 2, 3}}, {{1, 4, 2, 5}}}});
    EXPECT_EQ(ranked.all.points.size(), 5u);
    for (Vec3 p : rank({{{{-0.0, 0, 0}, {1, -0.0, 0}, {0, 1, -0.0}, {0, -0.0, 1}}, {0, 0, 0, 0}}, {{{0, 1, 2, 3}}}})
                      .all.points.positions)
        for (int axis = 0; axis < 3; ++axis) EXPECT_FALSE(std::signbit(p[axis]));
}

TEST(RankedTetrahedra, box_and_spacing_are_those_of_points_that_are_used) {
    std::vector<Vec3> points = kCorners;
    points.push_back({100, -100, 5});
    const Ranked ranked = rank({{points, {1, 1, 1, 1, 9}}, {{{0, 1, 2, 3}}}});
    EXPECT_EQ(ranked.all.points.box.low, (Vec3{0, 0, 0}));
    EXPECT_EQ(ranked.all.points.box.high, (Vec3{1, 1, 1}));
    EXPECT_EQ(ranked.all.points.size(), 5u);
    EXPECT_DOUBLE_EQ(ranked.all.six_volumes, 1);
    EXPECT_DOUBLE_EQ(rank(test::mesh_of(test::solid_volume({4, 5, 3}))).all.spacing(), 1);
}

TEST(RankedTetrahedra, what_is_no_tetrahedron_is_named) {
    std::vector<Vec3> points = kCorners;
    points.push_back({0.25, 0.5, 0});
    points.push_back(points[1]);
    const auto said = [&](std::array<std::uint32_t, 4> corners) {
        return refusal({{points, {1, 1, 1, 1, 1, 1}}, {{{0, 1, 2, 3}}, {corners}}});
    };
    for (const std::array<std::uint32_t, 4>& corners : {std::array{0u, 1u, 2u, 4u},
                                                        {0u, 1u, 2u, 6u},
                                                        {0u, 1u, 2u, 0xFFFFFFFFu},
                                                        {0u, 1u, 1u, 2u},
                                                        {0u, 1u, 5u, 2u}}) {
        EXPECT_THAT(said(corners), HasSubstr("mesh: cell 1"));
        EXPECT_THAT(said(corners), HasSubstr("mend the mesh"));
    }
    EXPECT_THAT(said({0, 1, 2, 4}), HasSubstr("flat"));
    EXPECT_THAT(said({0, 1, 2, 6}), HasSubstr("none of the points"));
    EXPECT_THAT(said({0, 1, 1, 2}), HasSubstr("one place"));
    EXPECT_THAT(said({0, 1, 5, 2}), HasSubstr("one place"));
    EXPECT_EQ(said({1, 4, 3, 2}), "nothing thrown");
}

TEST(RankedTetrahedra, points_without_labels_or_places_are_refused) {
    const std::vector<LabelledTetrahedron> one{{{0, 1, 2, 3}}};
    EXPECT_THAT(refusal({{kCorners, {1, 1, 1}}, one}), HasSubstr("3 labels for 4 points"));
    for (const int axis : {0, 1, 2}) {
        std::vector<Vec3> points = kCorners;
        points[2][axis] = std::nan("");
        EXPECT_THAT(refusal({{points, {1, 1, 1, 1}}, one}), HasSubstr("node 2 has a coordinate that is not a number"));
    }
    for (const double scale_z : {0.0, -2.0, HUGE_VAL})
        EXPECT_THAT(refusal(ArrayMesh({kCorners, {1, 1, 1, 1}}, one).scaled(scale_z)), HasSubstr("scale_z is"));
}

TEST(RankedTetrahedra, the_thinnest_tetrahedron_is_not_flat) {
    std::vector<Vec3> points = kCorners;
    points[3] = {0.3, 0.3, std::ldexp(1, -1000)};
    EXPECT_EQ(refusal({{points, {1, 1, 1, 1}}, {{{0, 1, 2, 3}}}}), "nothing thrown");
}

TEST(RankedTetrahedra, mesh_without_tetrahedra_is_refused) {
    EXPECT_THAT(refusal({{kCorners, {1, 1, 1, 1}}, {}}), HasSubstr("mesh: has no tetrahedra"));
    EXPECT_THAT(refusal({{{}, {}}, {}}), HasSubstr("mesh: has no tetrahedra"));
}

TEST(RankedTetrahedra, more_points_than_memory_holds_are_refused_in_words_of_the_option) {
    const std::string said = refusal(test::mesh_of(test::solid_volume({10, 10, 10})), {.memory = 10000});
    for (const char* part : {"--memory", "1000 points", "mesh"}) EXPECT_THAT(said, HasSubstr(part));
}

TEST(RankedTetrahedra, memory_for_sorting_does_not_matter) {
    const ArrayMesh mesh = test::bent_mesh({12, 11, 10}, 4, 7).shuffled(8);
    const Ranked small = rank(mesh, {.sweep = kSweepZ, .sort_bytes = 0}), large = rank(mesh);
    ASSERT_EQ(small.tetrahedra.size(), large.tetrahedra.size());
    for (std::size_t n = 0; n < small.tetrahedra.size(); ++n)
        EXPECT_EQ(small.tetrahedra[n].corners, large.tetrahedra[n].corners);
}

}  // namespace
}  // namespace regionmesh
