#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "mesh/strata.h"
#include "simplify/collapse_edges.h"
#include "simplify/placement/placement.h"
#include "support/runs.h"

namespace regionmesh {
namespace {

using test::run;

SimplifyOptions memoryless(std::uint32_t target_faces) {
    return {.target_faces = target_faces, .placement = PlacementKind::kLindstromTurk};
}

std::vector<double> volumes_of(const Mesh& mesh) {
    std::vector<double> volumes;
    for (const RegionReport& region : check(mesh).regions) {
        volumes.resize(std::max<std::size_t>(volumes.size(), region.label + 1));
        volumes[region.label] = region.volume;
    }
    return volumes;
}

/// Calls visit(star) for the edges within interfaces and along lines of a mesh.
template <class Visit>
void for_candidates(Mesh& mesh, Visit&& visit) {
    count_labels(mesh);
    EdgeStar star;
    test::for_vertices(mesh, [&](VertexId v) {
        std::vector<VertexId> ends;
        mesh.for_star(v, [&](FaceId f, int place) { ends.push_back(mesh[f].vertices[(place + 1) % 3]); });
        for (VertexId w : ends) {
            if (edge_labels(mesh, v, w).size() != vertex_labels(mesh, v).size()) continue;
            gather(mesh, v, w, star);
            visit(star);
        }
    });
}

/// Signed volume by region that a collapse adds: the tetrahedra from its old faces to the merged vertex.
std::map<Label, double> swept_volumes(const Mesh& mesh, const EdgeStar& star, Vec3 p) {
    std::map<Label, double> volumes;
    const auto sweep = [&](FaceId f) {
        const auto [a, b, c] = mesh.corners(f);
        const double volume = dot(cross(b - a, c - a), p - a) / 6;
        volumes[mesh[f].labels[0]] += volume;
        volumes[mesh[f].labels[1]] -= volume;
    };
    for (const StarFace& face : star.faces) sweep(face.face);
    for (FaceId f : star.dead) sweep(f);
    return volumes;
}

TEST(LindstromTurk, a_collapse_keeps_the_volumes_of_all_regions) {
    Mesh mesh = run(test::grain_volume({14, 14, 14}, 12, 3)).mesh;
    collapse_edges(mesh, {.target_faces = mesh.face_count() / 2});
    const auto placement = (count_labels(mesh), make_placement(mesh, memoryless(0)));
    int kept = 0, all = 0;
    for_candidates(mesh, [&](const EdgeStar& star) {
        const Vec3 p = placement->place(mesh, star).first;
        double worst = 0;
        for (const auto& [label, volume] : swept_volumes(mesh, star, p))
            if (!is_exterior(label)) worst = std::max(worst, std::abs(volume));
        kept += worst < 1e-9;
        ++all;
    });
    EXPECT_GT(all, 1000);
    EXPECT_GT(kept, all * 95 / 100) << "where constraints depend on each other one of them gives way";
}

TEST(LindstromTurk, ranks_an_edge_by_the_cost_of_its_place) {
    Mesh mesh = run(test::grain_volume({10, 10, 10}, 6, 4)).mesh;
    const auto placement = (count_labels(mesh), make_placement(mesh, memoryless(0)));
    std::vector<EdgeCost> costs;
    for_candidates(mesh, [&](const EdgeStar& star) {
        placement->rank(mesh, star.goes, std::vector{star.stays}, costs);
        // The squared volumes of the tetrahedra swept are part of the cost.
        const Vec3 p = placement->place(mesh, star).first;
        double squares = 0;
        for (FaceId f : star.dead) {
            const auto [a, b, c] = mesh.corners(f);
            squares += std::pow(dot(cross(b - a, c - a), p - a) / 6, 2);
        }
        ASSERT_GE(costs[0].cost, 0.99 * squares - 1e-9);
        ASSERT_GE(costs[0].rank, costs[0].cost);
        ASSERT_GE(costs[0].weight, 0);
    });
}

TEST(LindstromTurk, keeps_the_coordinates_of_box_sides_to_the_bit) {
    Mesh mesh = run(test::noise_volume({6, 7, 8}, 3, 9).spaced({0.1, 0.7, 1.0 / 3})).mesh;
    const Vec3 high{5 * 0.1, 6 * 0.7, 7 * (1.0 / 3)};
    SimplifyOptions options = memoryless(0);
    options.promises.scale = 0.3;
    collapse_edges(mesh, options);
    test::for_vertices(mesh, [&](VertexId v) {
        for (int side = 0; side < 6; ++side) {
            if (!(mesh[v].sides >> side & 1)) continue;
            EXPECT_EQ(mesh.position(v)[side / 2], side % 2 ? high[side / 2] : 0.0);
        }
    });
    test::expect_sound(check(mesh));
}

TEST(LindstromTurk, keeps_volumes_better_than_quadrics) {
    const auto change = [](PlacementKind placement) {
        Mesh mesh = run(test::ball_volume({24, 24, 24}, 9.3)).mesh;
        const std::vector<double> before = volumes_of(mesh);
        collapse_edges(mesh, {.target_faces = mesh.face_count() / 10, .placement = placement});
        test::expect_sound(check(mesh));
        return std::abs(volumes_of(mesh)[1] / before[1] - 1);
    };
    EXPECT_LT(change(PlacementKind::kLindstromTurk), 0.3 * change(PlacementKind::kQuadric));
}

TEST(LindstromTurk, meets_every_verdict_in_noise_and_stays_sound) {
    Mesh mesh = run(test::noise_volume({8, 8, 8}, 3, 5)).mesh;
    SimplifyOptions options = memoryless(0);
    options.promises.max_error = 1;
    options.promises.samples = Lattice{.size = {8, 8, 8}};
    const CollapseResult done = collapse_edges(mesh, options);
    // All but those of promises that are not asked for here.
    for (int n = 0; n <= static_cast<int>(Verdict::kIntersect); ++n)
        EXPECT_GT(done.verdicts[n], 0u) << kVerdictNames[n];
    test::expect_sound(check(mesh));
}

TEST(LindstromTurk, a_box_of_one_label_goes_down_to_twelve_faces) {
    Mesh mesh = run(test::solid_volume({7, 6, 5})).mesh;
    collapse_edges(mesh, memoryless(0));
    EXPECT_EQ(mesh.face_count(), 12u);
}

}  // namespace
}  // namespace regionmesh
