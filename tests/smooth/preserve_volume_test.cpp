#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <string_view>

#include "mesh/alive.h"
#include "mesh/region_volumes.h"
#include "regionmesh/smooth.h"
#include "smooth/filters/guarded_move.h"
#include "support/digest.h"
#include "support/runs.h"
#include "support/shapes.h"

namespace regionmesh {
namespace {

ReconstructOptions preserving(ReconstructOptions options) {
    options.smooth = {};
    options.preserve_volume = true;
    return options;
}

TEST(RegionVolumes, sum_to_that_of_the_box) {
    const Mesh mesh = test::run(test::grain_volume({9, 8, 7}, 5, 2)).mesh;
    double sum = 0;
    for (double volume : region_volumes(mesh)) {
        EXPECT_GT(volume, 0);
        sum += volume;
    }
    EXPECT_NEAR(sum, 8 * 7 * 6, 1e-9);
}

TEST(RegionVolumes, are_as_exact_far_from_the_origin) {
    Mesh mesh = test::run(test::grain_volume({9, 8, 7}, 5, 2)).mesh;
    const std::vector<double> near = region_volumes(mesh);
    for (std::uint32_t v = 0; v < mesh.vertex_end(); ++v) mesh[VertexId{v}].position += Vec3{0x1p23, -0x1p24, 0x1p22};
    const std::vector<double> far = region_volumes(mesh);
    for (std::size_t label = 0; label < near.size(); ++label) EXPECT_NEAR(far[label] / near[label], 1, 1e-10);
}

/// Of a region, too, that lies far from the others.
TEST(RegionVolumes, are_as_exact_far_from_the_first_face) {
    Mesh mesh = test::run(test::ball_volume({9, 9, 9}, 3)).mesh;
    const double near = region_volumes(mesh)[1];
    for (std::uint32_t v = 0; v < mesh.vertex_end(); ++v) mesh[VertexId{v}].position += Vec3{20001, -30003, 10007};
    std::vector<double> volumes;
    std::optional<Vec3> apex = Vec3{0, 0, 0};
    for (std::uint32_t f = 0; f < mesh.face_end(); ++f) {
        const auto p = mesh.corners(FaceId{f});
        add_cone(volumes, apex, mesh[FaceId{f}].labels, p[0], p[1], p[2]);
    }
    EXPECT_NEAR(volumes[1] / near, 1, 1e-9);
}

TEST(PreserveVolume, gives_a_shrunk_ball_its_volume_back) {
    Mesh mesh = test::run(test::ball_volume({21, 21, 21}, 7)).mesh;
    const std::vector<double> before = region_volumes(mesh);
    smooth(mesh, {.filter = SmoothFilter::kLaplacian, .passes = 40});
    EXPECT_LT(region_volumes(mesh)[1], 0.97 * before[1]);
    const PreserveReport report = preserve_volumes(mesh, {before.begin(), before.end()}, {});
    EXPECT_GT(report.drift_before, 0.03);
    EXPECT_LT(report.drift, 1e-8);
    EXPECT_EQ(report.regions_off, 0u);
    EXPECT_NEAR(region_volumes(mesh)[1] / before[1], 1, 1e-8);
    test::expect_sound(check(mesh));
}

TEST(PreserveVolume, leaves_free_regions_free) {
    Mesh mesh = test::run(test::ball_volume({21, 21, 21}, 7)).mesh;
    const std::uint64_t same = test::digest(mesh);
    EXPECT_EQ(preserve_volumes(mesh, {std::nullopt, std::nullopt}, {}).rounds, 0u);
    EXPECT_EQ(test::digest(mesh), same);
    const double before = region_volumes(mesh)[1];
    EXPECT_EQ(preserve_volumes(mesh, {std::nullopt, 1.01 * before}, {}).regions_off, 0u);
    EXPECT_NEAR(region_volumes(mesh)[1], 1.01 * before, 1e-6);
}

TEST(PreserveVolume, keeps_all_grains_after_smoothing) {
    test::ArrayVolume volume = test::grain_volume({30, 25, 20}, 12, 5);
    const Reconstruction made = test::run(volume, preserving(test::plain()));
    EXPECT_GT(made.report.preserved.drift_before, 1e-5);
    EXPECT_LT(made.report.preserved.drift, 1e-6);
    const std::vector<double> exact = region_volumes(test::run(volume).mesh), now = region_volumes(made.mesh);
    ASSERT_EQ(now.size(), exact.size());
    for (std::size_t n = 0; n < exact.size(); ++n) EXPECT_NEAR(now[n] / exact[n], 1, 1e-6);
    test::expect_sound(made.report.check);
}

TEST(PreserveVolume, takes_back_what_decimation_changed) {
    test::ArrayVolume volume = test::grain_volume({40, 30, 30}, 12, 6);
    for (std::uint32_t passes : {0u, 20u}) {
        ReconstructOptions options = preserving(test::reduced(0.8));
        options.smooth.filter = SmoothFilter::kTaubin;
        options.smooth.passes = passes;
        const Reconstruction made = test::run(volume, options);
        EXPECT_GT(made.report.preserved.drift_before, 1e-6);
        EXPECT_EQ(made.report.preserved.regions_off, 0u);
        EXPECT_GE(made.report.check.quality.min, 0.1 - 1e-12);
        test::expect_sound(made.report.check);
    }
}

TEST(PreserveVolume, keeps_to_the_box) {
    test::ArrayVolume volume = test::grain_volume({20, 20, 20}, 8, 9);
    Mesh mesh = test::run(volume).mesh;
    const std::vector<double> before = region_volumes(mesh);
    WantedVolumes wanted(before.begin(), before.end());
    wanted[0] = 1.02 * before[0];
    wanted[1].reset();
    const Mesh was = test::run(volume).mesh;
    preserve_volumes(mesh, wanted, {});
    for (std::uint32_t n = 0; n < mesh.vertex_end(); ++n) {
        const VertexId v{n};
        for (int axis = 0; axis < 3; ++axis) {
            if (was[v].sides >> (2 * axis) & 3) {
                EXPECT_EQ(mesh.position(v)[axis], was.position(v)[axis]);
            }
        }
    }
    EXPECT_NEAR(region_volumes(mesh)[0], 1.02 * before[0], 1e-6);
}

TEST(PreserveVolume, no_vertex_leaves_the_box) {
    for (std::uint32_t seed = 0; seed < 30; ++seed) {
        test::ArrayVolume volume = test::noise_volume({3, 4, 4}, 2, seed);
        for (const CellKind cells : {CellKind::kTetrahedra, CellKind::kCompact}) {
            const Reconstruction made =
                test::run(volume, {.cells = cells, .preserve_volume = true, .decimate = false, .background = {0}});
            for_vertices(made.mesh, [&](VertexId v) {
                const Vec3 p = made.mesh.position(v);
                for (int axis = 0; axis < 3; ++axis) {
                    EXPECT_GE(p[axis], 0) << seed;
                    EXPECT_LE(p[axis], axis == 0 ? 2 : 3) << seed;
                }
            });
            test::expect_sound(made.report.check);
        }
    }
}

TEST(PreserveVolume, no_vertex_passes_a_side_that_others_lie_on) {
    for (std::uint32_t seed = 0; seed < 30; ++seed) {
        const test::ArrayVolume volume = test::noise_volume({3, 4, 4}, 2, seed);
        Reconstruction made = test::run(test::ArrayVolume(volume), {.cells = CellKind::kTetrahedra, .decimate = false});
        std::array<bool, 6> has_vertices{};
        for_vertices(made.mesh, [&](VertexId v) {
            for (int side = 0; side < 6; ++side) has_vertices[side] |= (made.mesh[v].sides >> side & 1) != 0;
        });
        WantedVolumes wanted(made.report.unsmoothed_volumes.begin(), made.report.unsmoothed_volumes.end());
        for (const Label label : made.background) wanted[label].reset();
        preserve_volumes(made.mesh, wanted, {});
        for_vertices(made.mesh, [&](VertexId v) {
            for (int side = 0; side < 6; ++side) {
                const double place = made.mesh.position(v)[side / 2];
                if (!has_vertices[side]) continue;
                if (side % 2 == 0)
                    EXPECT_GE(place, 0) << seed;
                else
                    EXPECT_LE(place, side == 1 ? 2 : 3) << seed;
            }
        });
    }
}

TEST(PreserveVolume, open_models_may_be_turned) {
    // A ball between two regions, whose interface ends at the sides of the box.
    std::vector<InputLabel> labels;
    for (int z = -10; z <= 10; ++z)
        for (int y = -10; y <= 10; ++y)
            for (int x = -10; x <= 10; ++x) labels.push_back(x * x + y * y + z * z < 36 ? 3 : z < 0 ? 1 : 2);
    test::ArrayVolume volume({21, 21, 21}, std::move(labels));
    const auto rounds_at = [&](double degrees) {
        Reconstruction made = test::run(volume, {.decimate = false, .cap = false, .background = {}});
        const double c = std::cos(degrees * std::numbers::pi / 180), s = std::sin(degrees * std::numbers::pi / 180);
        for_vertices(made.mesh, [&](VertexId v) {
            Vec3& p = made.mesh[v].position;
            p = {c * p.x - s * p.y, s * p.x + c * p.y, p.z};
        });
        const Label ball = made.labels.dense(3);
        WantedVolumes wanted(3);
        wanted[ball] = 1.05 * region_volumes(made.mesh)[ball];
        const PreserveReport report = preserve_volumes(made.mesh, wanted, {});
        EXPECT_EQ(report.regions_off, 0u) << degrees;
        return report.rounds;
    };
    const std::uint32_t rounds = rounds_at(0);
    for (const double degrees : {45, 135, 180}) EXPECT_LE(rounds_at(degrees), rounds + 1) << degrees;
}

/// Six labels, dense and noisy: islands of few samples that volumes push through each other.
constexpr std::string_view kIslands =
    "555555555555555555555555555555555555555055555555555555555555555555555555555555550555555555555555555055555"
    "555555555555555555555555555555555555555555555505055555555555555555555555555555555555555555555555555555550"
    "505050555555555555555555555555555555555555555555555555555555555055555550555555555555555555555555555555555"
    "555555555555555000005555500050555551555555555555555555555555555550055555555000055555500000555550555555555"
    "555555555555555555550555555555000005555500000555555555555555555555555555555555550555555555000055555500000"
    "555550555555555555555555500555555550000555533000005555505555555555555555555555555555550555555550044555555"
    "000055555500055555555555555555555555555500055555550000555555000055555550055555555555225555555555555500055"
    "555550000055555000055555550055555555555222555555555555555555555550005555555000005555500005555555550055555";

TEST(PreserveVolume, keeps_islands_where_they_are) {
    std::vector<InputLabel> labels;
    for (char digit : kIslands) labels.push_back(digit - '0');
    test::ArrayVolume volume({10, 6, 14}, std::move(labels));
    ReconstructOptions options = test::reduced(0.95);
    options.preserve_volume = true;
    const Reconstruction made = test::run(volume, options);
    test::expect_sound(made.report.check);
    EXPECT_EQ(made.report.preserved.regions_off, 0u);
}

TEST(PreserveVolume, puts_no_region_farther_off) {
    for (std::uint32_t seed : {1u, 2u, 3u}) {
        test::ArrayVolume volume = test::noise_volume({16, 14, 9}, 60, seed);
        const std::vector<double> wanted = region_volumes(test::run(volume).mesh);
        Mesh mesh = test::run(volume, test::reduced(0.9)).mesh;
        const std::vector<double> before = region_volumes(mesh);
        const PreserveReport report = preserve_volumes(mesh, {wanted.begin(), wanted.end()}, {});
        test::expect_sound(check(mesh));
        const std::vector<double> now = region_volumes(mesh);
        std::uint64_t off = 0;
        for (std::size_t n = 0; n < wanted.size(); ++n) {
            const double was_off = std::abs(before[n] / wanted[n] - 1), is_off = std::abs(now[n] / wanted[n] - 1);
            EXPECT_LE(is_off, std::max(was_off, kVolumeTolerance) * (1 + 1e-9)) << seed << " region " << n;
            off += is_off > kVolumeTolerance;
        }
        EXPECT_EQ(report.regions_off, off);
    }
}

TEST(MoveGuarded, turns_no_region_inside_out) {
    // A flat tetrahedron, region 0 in region 1, whose apex wants to go through its base: no face would turn over, and
    // none would cross another.
    const double low = 0.05;
    Mesh mesh = test::shape({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, low}},
                            {{{0, 2, 1}}, {{0, 1, 3}}, {{1, 2, 3}}, {{2, 0, 3}}});
    std::vector<Vec3> to;
    for (std::uint32_t v = 0; v < 4; ++v) to.push_back(mesh.position(VertexId{v}));
    to[3].z = -low;
    ASSERT_GT(region_volumes(mesh)[0], 0);
    SmoothOptions options;
    options.min_quality = 0;
    move_guarded(mesh, to, options);
    EXPECT_GT(region_volumes(mesh)[0], 0);
}

}  // namespace
}  // namespace regionmesh
