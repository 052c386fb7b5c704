// The guard: no face turns over, loses its quality, crosses another or sweeps over an island, as the filter alone
// would let it.
#include <gtest/gtest.h>

#include <cmath>

#include "base/triangle.h"
#include "regionmesh/smooth.h"
#include "smooth/filters/backtrack.h"
#include "support/digest.h"
#include "support/runs.h"
#include "support/shapes.h"
#include "support/surface_windows.h"

namespace regionmesh {
namespace {

using test::run;

constexpr SmoothOptions kHarsh{.filter = SmoothFilter::kLaplacian, .passes = 100};

std::uint64_t count(const CheckReport& report, ViolationKind kind) { return report.counts[static_cast<int>(kind)]; }

SmoothOptions unguarded(SmoothOptions options) {
    options.min_quality = 0;
    options.intersect_check = false;
    return options;
}

/// By 90 degrees or more.
std::uint64_t turned_faces(const Mesh& before, const Mesh& after) {
    std::uint64_t turned = 0;
    test::for_faces(after, [&](FaceId f) {
        const auto p = before.corners(f), q = after.corners(f);
        turned += !(dot(area_vector(p[0], p[1], p[2]), area_vector(q[0], q[1], q[2])) > 0);
    });
    return turned;
}

/// No face is below the bound, but those that were; these have lost half at most.
void expect_quality(const Mesh& before, const Mesh& after, double min_quality) {
    std::uint64_t bad = 0;
    test::for_faces(after, [&](FaceId f) {
        const auto p = before.corners(f), q = after.corners(f);
        const double was = face_quality(p[0], p[1], p[2]), is = face_quality(q[0], q[1], q[2]);
        bad += is < (was < min_quality ? 0.5 * was : min_quality) - 1e-12;
    });
    EXPECT_EQ(bad, 0u);
}

/// Sheets of label 1, one sample thick and with steps, two samples apart.
test::ArrayVolume thin_sheets() {
    std::vector<InputLabel> labels;
    for (int z = 0; z < 8; ++z)
        for (int y = 0; y < 8; ++y)
            for (int x = 0; x < 8; ++x) labels.push_back((z + (x / 3) % 2 + (y / 4) % 2) % 3 == 0);
    return {{8, 8, 8}, std::move(labels)};
}

void expect_guarded(const Mesh& before, const SmoothOptions& options) {
    Mesh mesh = test::copy_of(before);
    const SmoothReport report = smooth(mesh, options);
    test::expect_sound(check(mesh));
    EXPECT_EQ(turned_faces(before, mesh), 0u);
    expect_quality(before, mesh, options.min_quality);
    EXPECT_GT(report.rms_displacement, 0) << "nothing was smoothed";
}

TEST(IntersectionResolver, what_the_filter_would_cross_does_not_cross) {
    for (std::uint32_t labels : {2, 4}) {
        SCOPED_TRACE(std::to_string(labels) + " labels");
        const Mesh before = run(test::noise_volume({8, 8, 8}, labels, 3)).mesh;
        Mesh spoilt = test::copy_of(before), mesh = test::copy_of(before);
        smooth(spoilt, unguarded(kHarsh));
        ASSERT_GT(count(check(spoilt), ViolationKind::kCrossingFaces), 0u) << "the filter alone does no harm here";
        const SmoothReport report = smooth(mesh, kHarsh);
        test::expect_sound(check(mesh));
        EXPECT_EQ(turned_faces(before, mesh), 0u);
        EXPECT_GE(check(mesh).quality.min, 0.1);
        EXPECT_GT(report.turned_faces, 0u);
        EXPECT_GT(report.low_quality_faces, 0u);
        EXPECT_GT(report.crossing_pairs, 0u);
        EXPECT_GT(report.backtracked, 0u);
    }
}

TEST(IntersectionResolver, thin_sheets_stay_apart) {
    const Mesh before = run(thin_sheets()).mesh;
    for (SmoothFilter filter : {SmoothFilter::kTaubin, SmoothFilter::kLaplacian, SmoothFilter::kNifpms})
        for (std::uint32_t passes : {20u, 100u}) {
            SCOPED_TRACE("filter " + std::to_string(static_cast<int>(filter)) + ", " + std::to_string(passes) +
                         " passes");
            expect_guarded(before, {.filter = filter, .passes = passes});
        }
}

TEST(IntersectionResolver, keeps_any_quality_that_it_is_asked_for) {
    const Mesh before = run(test::noise_volume({7, 7, 7}, 3, 2)).mesh;
    for (double quality : {0.0, 0.05, 0.13, 0.2}) {
        SCOPED_TRACE("quality " + std::to_string(quality));
        expect_guarded(before, {.passes = 60, .min_quality = quality});
    }
}

TEST(IntersectionResolver, a_share_of_the_way_beyond_reason_is_survived) {
    const Mesh before = run(test::noise_volume({7, 7, 7}, 3, 2)).mesh;
    expect_guarded(before, {.filter = SmoothFilter::kTaubin, .passes = 60, .lambda = 1, .mu_per_lambda = 1.5});
}

TEST(IntersectionResolver, without_its_crossing_test_faces_are_still_not_turned) {
    const Mesh before = run(test::noise_volume({8, 8, 8}, 3, 3)).mesh;
    Mesh mesh = test::copy_of(before);
    SmoothOptions options = kHarsh;
    options.intersect_check = false;
    const SmoothReport report = smooth(mesh, options);
    EXPECT_EQ(turned_faces(before, mesh), 0u);
    EXPECT_GE(check(mesh).quality.min, 0.1);
    EXPECT_EQ(report.crossing_pairs, 0u);
}

/// Region 1 is all round.
const CheckOptions kAllRound{.background = {1}};

/// A closed surface with a spike on its top: a double pyramid over a ring of eight, its upper tip at height 4; inside
/// 0, outside 1. In the spike, at this height, an octahedron of region 2.
Mesh spike_with_island(double height) {
    std::vector<Vec3> p{{0, 0, 4}, {0, 0, -1}};
    std::vector<test::ShapeFace> faces;
    constexpr std::uint32_t kRing = 8;
    for (std::uint32_t n = 0; n < kRing; ++n)
        p.push_back({std::cos(n * std::acos(-1.0) / 4), std::sin(n * std::acos(-1.0) / 4), 0});
    for (std::uint32_t n = 0; n < kRing; ++n) {
        const std::uint32_t a = 2 + n, b = 2 + (n + 1) % kRing;
        faces.push_back({{a, b, 0}, 0, 1});
        faces.push_back({{b, a, 1}, 0, 1});
    }
    Mesh mesh = test::shape(p, faces);
    test::add_octahedron(mesh, {0, 0, height}, {0.1, 0.1, 0.1}, 2, 0);
    return mesh;
}

TEST(IntersectionResolver, an_island_that_the_surface_would_sweep_over_stays_inside) {
    for (double height : {1.8, 2.5, 3.2}) {
        SCOPED_TRACE("island at height " + std::to_string(height));
        SmoothOptions options{.filter = SmoothFilter::kLaplacian, .passes = 10, .min_quality = 0.01};
        Mesh mesh = spike_with_island(height), swept = spike_with_island(height);
        test::expect_sound(check(mesh, kAllRound));
        smooth(swept, unguarded(options));
        ASSERT_EQ(count(check(swept, kAllRound), ViolationKind::kCrossingFaces), 0u);
        ASSERT_GT(count(check(swept, kAllRound), ViolationKind::kNesting), 0u) << "the filter alone leaves it inside";
        const SmoothReport report = smooth(mesh, options);
        test::expect_sound(check(mesh, kAllRound));
        EXPECT_GT(report.islands, 0u);
    }
}

TEST(IntersectionResolver, whichever_vertex_stands_for_an_island_it_stays_inside) {
    for (double height : {1.8, 2.5, 3.2})
        for (std::uint64_t seed = 1; seed <= 20; ++seed) {
            SCOPED_TRACE("island at height " + std::to_string(height) + ", seed " + std::to_string(seed));
            Mesh mesh = test::renumbered(spike_with_island(height), seed);
            smooth(mesh, {.filter = SmoothFilter::kLaplacian, .passes = 10, .min_quality = 0.01});
            test::expect_sound(check(mesh, kAllRound));
        }
}

TEST(IntersectionResolver, which_vertex_stands_for_an_island_does_not_matter) {
    for (std::uint64_t seed : {1, 2, 3}) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        const SmoothOptions options{.filter = SmoothFilter::kLaplacian, .passes = 10, .min_quality = 0.01};
        Mesh mesh = spike_with_island(2.5), other = test::renumbered(mesh, seed);
        smooth(mesh, options);
        smooth(other, options);
        EXPECT_EQ(test::surface_digest(mesh), test::surface_digest(other));
    }
}

TEST(IntersectionResolver, an_island_that_nothing_sweeps_over_is_none_to_count) {
    Mesh mesh = spike_with_island(-0.2);
    const SmoothReport report = smooth(mesh, {.passes = 2, .min_quality = 0.01});
    EXPECT_EQ(report.islands, 0u);
    test::expect_sound(check(mesh, kAllRound));
}

TEST(IntersectionResolver, single_samples_in_a_spike_stay_where_the_labels_say) {
    // A spike of 0, three samples wide, with samples of 2 in it, in a volume of 1.
    std::vector<InputLabel> labels;
    for (int z = 0; z < 14; ++z)
        for (int y = 0; y < 9; ++y)
            for (int x = 0; x < 9; ++x) {
                const bool is_spike = z < 2 || (z < 11 && std::abs(x - 4) <= 1 && std::abs(y - 4) <= 1);
                const bool is_island = x == 4 && y == 4 && z % 3 == 0 && z > 2 && z < 11;
                labels.push_back(is_island ? 2 : is_spike ? 0 : 1);
            }
    test::ArrayVolume volume({9, 9, 14}, std::move(labels));
    for (SmoothFilter filter : {SmoothFilter::kTaubin, SmoothFilter::kLaplacian, SmoothFilter::kNifpms})
        for (std::uint32_t passes : {20u, 100u}) {
            SCOPED_TRACE("filter " + std::to_string(static_cast<int>(filter)) + ", " + std::to_string(passes) +
                         " passes");
            test::expect_sound(
                run(volume, {.smooth = {.filter = filter, .passes = passes}, .decimate = false, .background = {}})
                    .report.check);
        }
}

TEST(IntersectionResolver, a_model_that_crosses_itself_is_no_reason_to_give_up) {
    Mesh mesh = test::octahedron();
    test::add_octahedron(mesh, {0.5, 0.1, 0.2}, {1, 1, 1}, 2, 1);
    const std::uint64_t before = count(check(mesh), ViolationKind::kCrossingFaces);
    ASSERT_GT(before, 0u);
    smooth(mesh, {});
    EXPECT_LE(count(check(mesh), ViolationKind::kCrossingFaces), before);
}

TEST(IntersectionResolver, faces_without_area_are_no_reason_to_give_up) {
    Mesh mesh = run(test::ball_volume({8, 8, 8}, 2.5)).mesh;
    // One vertex is put on another.
    VertexId v{};
    test::for_vertices(mesh, [&](VertexId w) {
        if (mesh[w].sides == 0) v = w;
    });
    VertexId next{};
    mesh.for_star(v, [&](FaceId f, int place) { next = mesh[f].vertices[(place + 1) % 3]; });
    mesh[v].position = mesh.position(next);
    const CheckReport before = check(mesh);
    for (SmoothFilter filter : {SmoothFilter::kTaubin, SmoothFilter::kLaplacian, SmoothFilter::kNifpms}) {
        smooth(mesh, {.filter = filter});
        EXPECT_LE(count(check(mesh), ViolationKind::kDegenerateFace), count(before, ViolationKind::kDegenerateFace));
    }
}

TEST(IntersectionResolver, smoothing_again_and_again_stays_sound) {
    Mesh mesh = run(test::noise_volume({7, 7, 7}, 4, 6)).mesh;
    for (int time = 0; time < 5; ++time) {
        smooth(mesh, time % 2 ? kHarsh : SmoothOptions{});
        test::expect_sound(check(mesh));
        EXPECT_GE(check(mesh).quality.min, 0.1);
    }
}

}  // namespace
}  // namespace regionmesh
