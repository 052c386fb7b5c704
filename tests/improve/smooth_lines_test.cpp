#include "regionmesh/smooth_lines.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>
#include <vector>

#include "mesh/strata.h"
#include "regionmesh/simplify.h"
#include "support/digest.h"
#include "support/runs.h"
#include "support/strata_list.h"

namespace regionmesh {
namespace {

using test::run;

ReconstructOptions with_smooth_lines(double share) {
    ReconstructOptions options{.smooth_lines = true, .background = {}};
    if (share > 0) options.reduce = share;
    return options;
}

/// Labels by place, from {x, y, z} less `middle`.
template <class LabelOf>
test::ArrayVolume volume_of(std::uint32_t side, Vec3 middle, const LabelOf& label_of) {
    std::vector<InputLabel> labels;
    for (std::uint32_t z = 0; z < side; ++z)
        for (std::uint32_t y = 0; y < side; ++y)
            for (std::uint32_t x = 0; x < side; ++x)
                labels.push_back(label_of(Vec3{1.0 * x, 1.0 * y, 1.0 * z} - middle));
    return {{side, side, side}, std::move(labels)};
}

/// Mean squared distance of the vertices of lines inside the box from where lines are.
template <class DistanceOf>
double squared_distance(const Mesh& mesh, const DistanceOf& distance_of) {
    double sum = 0, count = 0;
    test::for_vertices(mesh, [&](VertexId v) {
        if (mesh[v].sides != 0 || vertex_labels(mesh, v).size() != 3) return;
        sum += std::pow(distance_of(mesh.position(v)), 2);
        ++count;
    });
    return sum / count;
}

TEST(SmoothLines, brings_lines_nearer_to_the_truth) {
    const Vec3 middle{13.3, 13.6, 13.4};
    for (const double share : {0.0, 0.8, 0.95}) {
        double before = 0, after = 0;  // sums of squared distances
        for (const Vec3 direction : {Vec3{0.63, 0.63, -0.45}, Vec3{-0.55, 0.41, -0.73}, Vec3{0.83, -0.54, 0.11}}) {
            const Vec3 along = direction / length(direction);
            const Vec3 across = cross(along, {1, 0, 0}) / length(cross(along, {1, 0, 0})), third = cross(along, across);
            test::ArrayVolume volume = volume_of(28, middle, [&](Vec3 p) {
                const double angle = std::atan2(dot(p, third), dot(p, across)) + std::numbers::pi;
                return static_cast<InputLabel>(1 + std::min(2.0, std::floor(angle / (2 * std::numbers::pi / 3))));
            });
            const auto from_line = [&](Vec3 p) { return length(cross(p - middle, along)); };
            ReconstructOptions options = with_smooth_lines(share);
            const Reconstruction made = run(volume, options);
            test::expect_sound(made.report.check);
            EXPECT_EQ(made.report.samples.value().wrong, 0u);
            const SmoothLinesResult& done = made.report.smoothed_lines.value();
            EXPECT_LT(done.turn_after, 0.7 * done.turn_before);
            after += squared_distance(made.mesh, from_line);
            options.smooth_lines = false;
            before += squared_distance(run(volume, options).mesh, from_line);
        }
        EXPECT_LT(after, 0.85 * before) << share;
    }
}

TEST(SmoothLines, keeps_a_ring_round) {
    const Vec3 middle{13.6, 13.4, 13.7}, normal = Vec3{0.2, 0.3, 0.9} / length(Vec3{0.2, 0.3, 0.9});
    test::ArrayVolume volume = volume_of(28, middle, [&](Vec3 p) -> InputLabel {
        return length(p) > 9.3 ? 1 : dot(p, normal) > 0 ? 2 : 3;
    });
    const auto from_ring = [&](Vec3 p) {
        const double height = dot(p - middle, normal);
        return std::hypot(height, length(p - middle - height * normal) - 9.3);
    };
    ReconstructOptions options = with_smooth_lines(0.7);
    const double after = squared_distance(run(volume, options).mesh, from_ring);
    options.smooth_lines = false;
    EXPECT_LT(after, squared_distance(run(volume, options).mesh, from_ring));
}

TEST(SmoothLines, keeps_every_sample_and_adds_no_violation) {
    test::ArrayVolume volumes[] = {test::noise_volume({9, 8, 10}, 4, 1), test::grain_volume({20, 18, 22}, 9, 3)};
    for (test::ArrayVolume& volume : volumes)
        for (const Vec3 spacing : {Vec3{1, 1, 1}, Vec3{0.4, 0.4, 0.12}, Vec3{0.7, 1.3, 4}})
            for (const double share : {0.0, 0.5, 0.9})
                for (const SmoothFilter filter : {SmoothFilter::kLattice, SmoothFilter::kTaubin}) {
                    volume.lattice().spacing = spacing;
                    ReconstructOptions options = with_smooth_lines(share);
                    options.smooth.filter = filter;
                    const Reconstruction made = run(volume, options);
                    test::expect_sound(made.report.check);
                    EXPECT_EQ(made.report.samples.value().wrong, 0u);
                    const SmoothLinesResult& done = made.report.smoothed_lines.value();
                    EXPECT_LE(done.turn_after, done.turn_before);
                    EXPECT_LE(done.largest_displacement, std::cbrt(spacing.x * spacing.y * spacing.z) * (1 + 1e-9));
                }
}

TEST(SmoothLines, keeps_all_strata_and_the_sides_of_the_box) {
    Mesh mesh = run(test::grain_volume({20, 18, 22}, 9, 3), {.background = {}}).mesh;
    simplify(mesh, {.target_faces = mesh.face_count() / 5});
    const test::StrataList strata = test::list_strata(mesh);
    const SmoothLinesResult done = smooth_lines(mesh, {});
    EXPECT_GT(done.moves, 0u);
    EXPECT_LT(done.turn_after, 0.7 * done.turn_before);
    test::expect_same_strata(test::list_strata(mesh), strata);
    const double ends[] = {19, 17, 21};
    test::for_vertices(mesh, [&](VertexId v) {
        for (int side = 0; side < 6; ++side)
            if ((mesh[v].sides >> side & 1) != 0) {
                EXPECT_EQ(mesh.position(v)[side / 2], side % 2 == 0 ? 0 : ends[side / 2]) << "to the last bit";
            }
    });
}

TEST(SmoothLines, does_not_leave_an_open_box) {
    for (std::uint64_t seed = 1; seed <= 40; ++seed)
        for (const bool keep_samples : {true, false}) {
            ReconstructOptions options = with_smooth_lines(0.8);
            options.cap = false;
            options.keep_samples = keep_samples;
            const Mesh mesh = run(test::noise_volume({9, 7, 8}, 4, seed), options).mesh;
            test::for_vertices(mesh, [&](VertexId v) {
                for (int axis = 0; axis < 3; ++axis) {
                    EXPECT_GE(mesh.position(v)[axis], 0);
                    EXPECT_LE(mesh.position(v)[axis], axis == 0 ? 8 : axis == 1 ? 6 : 7);
                }
            });
        }
}

TEST(SmoothLines, counts_no_edges_of_the_box) {
    const Reconstruction made = run(test::solid_volume({9, 8, 7}), with_smooth_lines(0.5));
    EXPECT_EQ(made.report.smoothed_lines.value().vertices, 0u);
}

TEST(SmoothLines, leaves_fixed_vertices_and_what_is_on_no_line) {
    Mesh mesh = run(test::grain_volume({16, 16, 16}, 6, 3), {.background = {}}).mesh;
    simplify(mesh, {.target_faces = mesh.face_count() / 3});
    std::vector<Vec3> before;
    for (std::uint32_t v = 0; v < mesh.vertex_end(); ++v) before.push_back(mesh.position(VertexId{v}));
    test::for_vertices(mesh, [&](VertexId v) { mesh[v].is_fixed = true; });
    EXPECT_EQ(smooth_lines(mesh, {}).moves, 0u);
    test::for_vertices(mesh, [&](VertexId v) { mesh[v].is_fixed = false; });
    EXPECT_GT(smooth_lines(mesh, {}).moves, 0u);
    test::for_vertices(mesh, [&](VertexId v) {
        if (vertex_labels(mesh, v).size() == 2) {
            EXPECT_EQ(mesh.position(v), before[index(v)]);
        }
    });
}

TEST(SmoothLines, of_an_empty_mesh_does_nothing) {
    Mesh mesh;
    EXPECT_EQ(smooth_lines(mesh, {}).moves, 0u);
}

TEST(Determinism, smooth_lines_gives_the_same_bytes_for_any_number_of_threads) {
    test::ArrayVolume volume = test::grain_volume({20, 18, 22}, 9, 3);
    std::set<std::uint64_t> digests;
    for (std::uint32_t threads : {1, 2, 5}) {
        ReconstructOptions options = with_smooth_lines(0.8);
        options.threads = threads;
        digests.insert(test::digest(run(volume, options).mesh));
    }
    EXPECT_EQ(digests.size(), 1u);
}

}  // namespace
}  // namespace regionmesh
