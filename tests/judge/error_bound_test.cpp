// The bound of the distance to the surface before decimation, against the sampled distance.
#include "judge/error_bound.h"

#include <gtest/gtest.h>

#include "mesh/strata.h"
#include "regionmesh/compare.h"
#include "regionmesh/simplify.h"
#include "support/digest.h"
#include "support/runs.h"

namespace regionmesh {
namespace {

/// Rounding of the sampled distance.
constexpr double kRounding = 1e-9;

/// The larger of both ways, for every interface by itself.
double sampled_distance(const Reconstruction& a, const Reconstruction& b) {
    const CompareReport report =
        compare({a.mesh, a.labels}, {b.mesh, b.labels}, {.samples = 200'000, .background = {}});
    double largest = report.distance.both.value().max;
    for (const StratumComparison& interface : report.interfaces) {
        EXPECT_TRUE(interface.distance.both.has_value()) << "an interface is gone";
        if (interface.distance.both) largest = std::max(largest, interface.distance.both->max);
    }
    return largest;
}

struct Case {
    const char* name;
    test::ArrayVolume volume;
};

std::vector<Case> cases() {
    std::vector<Case> all;
    for (std::uint32_t seed : {1u, 2u, 3u}) {
        all.push_back({"noise", test::noise_volume({9, 8, 10}, 3, seed)});
        all.push_back({"grains", test::grain_volume({30, 28, 32}, 12, seed)});
    }
    all.push_back({"ball", test::ball_volume({24, 24, 24}, 8.3)});
    all.push_back({"steep ball", test::ball_volume({24, 24, 24}, 8.3)});
    all.back().volume.lattice().spacing = {0.7, 1.3, 3};
    return all;
}

/// Runs each case with each filter and goal, and hands over the surface before decimation and after.
template <class Visit>
void for_runs(const std::vector<ReconstructOptions>& goals, Visit&& visit) {
    for (Case& one : cases())
        for (bool is_smooth : {true, false}) {
            SCOPED_TRACE(std::string(one.name) + (is_smooth ? ", smooth" : ""));
            std::map<CellKind, Reconstruction> wholes;
            for (ReconstructOptions options : goals) {
                if (!is_smooth) options.smooth.passes = 0;
                options.background = {};
                // --preserve-volume makes the surface of tetrahedra
                const CellKind cells = options.preserve_volume ? CellKind::kTetrahedra : options.cells;
                if (!wholes.contains(cells)) {
                    const ReconstructOptions whole{
                        .cells = cells, .smooth = options.smooth, .decimate = false, .background = {}};
                    wholes.emplace(cells, test::run(one.volume, whole));
                }
                visit(wholes.at(cells), test::run(one.volume, options), options);
            }
        }
}

TEST(ErrorBound, is_never_below_the_distance) {
    for_runs({{.reduce = 0.5},
              {.reduce = 0.9},
              {.reduce = 0.97},
              {.reduce = 0.9, .placement = PlacementKind::kLindstromTurk},
              {.reduce = 0.9, .improve = true},
              {.reduce = 0.9, .smooth_lines = true},
              {.reduce = 0.8, .preserve_volume = true}},
             [](const Reconstruction& whole, const Reconstruction& made, const ReconstructOptions&) {
                 const double distance = sampled_distance(whole, made);
                 EXPECT_GT(distance, 0);
                 EXPECT_LE(distance, made.report.error_bound + kRounding);
             });
}

TEST(ErrorBound, max_error_is_kept) {
    for_runs({{.promises = {.max_error = 0.05}},
              {.promises = {.max_error = 0.3}},
              {.promises = {.max_error = 0.3}, .improve = true},
              {.promises = {.max_error = 0.3}, .smooth_lines = true},
              {.promises = {.max_error = 1}, .placement = PlacementKind::kLindstromTurk}},
             [](const Reconstruction& whole, const Reconstruction& made, const ReconstructOptions& options) {
                 EXPECT_LT(made.mesh.face_count(), whole.mesh.face_count());
                 EXPECT_LE(made.report.error_bound, options.promises.max_error);
                 EXPECT_LE(sampled_distance(whole, made), made.report.error_bound + kRounding);
                 const bool is_small = options.promises.max_error < 1;
                 EXPECT_TRUE(made.report.verdicts[static_cast<int>(Verdict::kError)] > 0 || !is_small);
                 EXPECT_EQ(made.report.stopped, StopReason::kMaxError);
             });
}

TEST(ErrorBound, begins_with_improvement_where_nothing_is_decimated) {
    test::ArrayVolume volume = test::noise_volume({12, 11, 16}, 4, 1);
    for (const CellKind cells : {CellKind::kCompact, CellKind::kTetrahedra}) {
        const Reconstruction whole = test::run(volume, {.cells = cells, .background = {}});
        const Reconstruction made = test::run(volume, {.cells = cells, .improve = true, .background = {}});
        const double distance = sampled_distance(whole, made);
        EXPECT_GT(distance, 0);
        EXPECT_LE(distance, made.report.error_bound + kRounding);
        EXPECT_LE(made.report.error_bound, 3 * ImproveOptions().tolerance);
    }
}

TEST(ErrorBound, holds_through_budgets_runs_and_tiles) {
    test::ArrayVolume volume = test::grain_volume({64, 60, 56}, 60, 21);
    const Reconstruction whole = test::run(volume, {.decimate = false, .background = {}});
    for (const auto& [budget, error] :
         {std::pair<std::uint64_t, std::optional<double>>{75'000, {}}, {75'000, 0.2}, {0, 0.2}})
        for (std::uint32_t strips : {1u, 7u}) {
            ReconstructOptions options{
                .promises = {.max_error = error.value_or(HUGE_VAL)}, .background = {}, .strips_per_chunk = strips};
            if (!error) options.reduce = 0.95;
            if (budget > 0) options.face_budget = budget;
            const Reconstruction made = test::run(volume, options);
            EXPECT_LE(made.report.error_bound, error.value_or(HUGE_VAL));
            EXPECT_LE(sampled_distance(whole, made), made.report.error_bound + kRounding);
        }
}

test::ArrayVolume one_label() {
    const test::Size size{12, 10, 14};
    return {size, std::vector<InputLabel>(std::size_t{size[0]} * size[1] * size[2], 1)};
}

TEST(ErrorBound, is_zero_where_flat_faces_stay_flat) {
    const Reconstruction made = test::run(one_label(), {.reduce = 0.95, .background = {}});
    EXPECT_EQ(made.report.error_bound, 0);
    const Reconstruction kept = test::run(one_label(), {.promises = {.max_error = 1e-6}, .background = {}});
    EXPECT_LT(kept.mesh.face_count(), 50u) << "what costs nothing goes";
}

/// A sheet of one interface, and at its rim a spike of another one, of a single face: g, the tip, may go to q.
struct Spike {
    Mesh mesh;
    VertexId g, q;

    Spike() {
        const auto add = [&](Vec3 p) { return mesh.add_vertex(p); };
        const VertexId a = add({-1, -1, 0}), b = add({1, -1, 0}), s = add({-0.5, 0, 0});
        q = add({0.5, 0, 0});
        g = add({0, 0.2, 5});
        mesh.add_face(s, q, g, 0, exterior(2));
        mesh.add_face(a, s, g, 0, 1);
        mesh.add_face(b, a, g, 0, 1);
        mesh.add_face(q, b, g, 0, 1);
        count_labels(mesh);
    }
};

TEST(ErrorBound, counts_an_interface_that_vanishes_from_the_star) {
    Spike spike;
    EdgeStar star;
    gather_half(spike.mesh, spike.g, spike.q, star);
    EXPECT_EQ(star.dead.size(), 2u);
    EXPECT_FALSE(star.is_interface);
    const Vec3 at = spike.mesh.position(spike.q);
    set_normals(star, at);
    note_flat(star, at);
    ErrorBound bound;
    EXPECT_GE(bound.merged(spike.mesh, star, at), 5);
}

TEST(ErrorBound, of_simplify_counts_from_the_mesh_as_it_comes) {
    Reconstruction made = test::run(test::grain_volume({16, 16, 16}, 8, 5));
    EXPECT_GT(simplify(made.mesh, {.target_faces = made.mesh.face_count() / 5}).error_bound, 0);
    EXPECT_GT(largest_error_bound(made.mesh), 0);
    EXPECT_EQ(simplify(made.mesh, {.target_faces = made.mesh.face_count()}).error_bound, 0);
}

TEST(ErrorBound, is_stored_rounded_up) {
    Vertex vertex;
    EXPECT_EQ(vertex.error_bound(), 0);
    for (double bound : {0.0, 1e-12, 0.1, 0.25, 1.0 / 3, 1.0, 7.3, 1e6}) {
        vertex.set_error_bound(bound);
        EXPECT_GE(vertex.error_bound(), bound);
        EXPECT_LE(vertex.error_bound(), bound * (1 + 1.0 / 512));
        const float stored = vertex.error_bound();
        vertex.set_error_bound(stored);
        EXPECT_EQ(vertex.error_bound(), stored);
    }
}

}  // namespace
}  // namespace regionmesh
