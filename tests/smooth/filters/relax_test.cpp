#include "smooth/filters/relax.h"

#include <gtest/gtest.h>

#include <bit>

#include "support/runs.h"
#include "support/shapes.h"
#include "support/surface_windows.h"

namespace regionmesh {
namespace {

using test::Surface;

/// Places after one pass over all vertices.
SlidingArray<Vec3> relaxed(const Surface& surface, const SlidingArray<Vec3>& from, double factor,
                           std::uint32_t threads = 1) {
    SlidingArray<Vec3> to;
    to.grow(from.end());
    relax(surface.window, surface.neighbours, surface.window.vertices_of(0), factor, from, to, threads);
    return to;
}

void expect_near(Vec3 p, Vec3 q) { EXPECT_LT(length(p - q), 1e-12); }

TEST(Relax, goes_a_share_of_the_way_to_the_mean_of_the_neighbours) {
    Mesh mesh = test::edge_in_sheet();
    mesh[VertexId{0}].position = {0, 0, 3};
    const Surface surface(mesh);
    // The mean of vertices 1 to 6 is (0, 0, 0), that of 0, 2, 3, 7, 8, 9 is (1, 0, 0.5).
    for (double factor : {0.6, 1.0, -0.612, 0.0}) {
        const auto to = relaxed(surface, surface.window.origin, factor);
        expect_near(to[0], {0, 0, 3 - 3 * factor});
        expect_near(to[1], {1, 0, 0.5 * factor});
        for (std::uint32_t v = 2; v < 10; ++v) EXPECT_EQ(to[v], surface.window.origin[v]) << "the rim stays";
    }
}

TEST(Relax, reads_the_places_it_is_given_and_not_where_they_came_from) {
    const Surface surface(test::octahedron());
    SlidingArray<Vec3> from;
    for (std::uint32_t v = 0; v < 6; ++v) from.push_back(surface.window.origin[v] + Vec3{5, 0, v == 5 ? 3.0 : 0.0});
    expect_near(relaxed(surface, from, 0.5)[5], {5, 0, 2});
    expect_near(relaxed(surface, from, 0.5)[0], {4.5, 0, 0.375});
}

TEST(Relax, lines_go_along_lines) {
    Mesh mesh = test::halved_octahedron();
    mesh[VertexId{0}].position = {-1, 0, 1};
    const auto to = relaxed(Surface(mesh), Surface(mesh).window.origin, 0.5);
    expect_near(to[0], {-0.5, 0, 0.5});
    expect_near(to[2], {0, -0.5, 0.25});
    expect_near(to[6], {0, 0, 0.125});
}

TEST(RelaxFactor, of_taubin_alternates_and_of_laplacian_does_not) {
    const SmoothOptions taubin{.filter = SmoothFilter::kTaubin, .lambda = 0.5, .mu_per_lambda = 1.04};
    const SmoothOptions laplacian{.filter = SmoothFilter::kLaplacian, .lambda = 0.5};
    for (std::uint32_t pass = 0; pass < 7; ++pass) {
        EXPECT_DOUBLE_EQ(relax_factor(taubin, pass), pass % 2 ? -0.52 : 0.5);
        EXPECT_DOUBLE_EQ(relax_factor(laplacian, pass), 0.5);
    }
    EXPECT_DOUBLE_EQ(relax_factor({.filter = SmoothFilter::kTaubin}, 1), -0.612);
}

TEST(Relax, keeps_the_coordinates_of_box_sides_to_the_bit) {
    const Mesh mesh = test::run(test::noise_volume({5, 6, 7}, 3, 9).spaced({0.1, 0.7, 1.0 / 3})).mesh;
    const Surface surface(mesh);
    const auto to = relaxed(surface, surface.window.origin, 0.6);
    int moved = 0;
    for (std::uint32_t v = 0; v < to.end(); ++v) {
        for (int side = 0; side < 6; ++side)
            if (surface.window.sides[v] >> side & 1) {
                EXPECT_EQ(to[v][side / 2], surface.window.origin[v][side / 2]);
            }
        moved += surface.window.sides[v] != 0 && to[v] != surface.window.origin[v];
        if (std::popcount(surface.window.sides[v]) == 3) {
            EXPECT_EQ(to[v], surface.window.origin[v]);
        }
    }
    EXPECT_GT(moved, 50) << "along their sides vertices go";
}

TEST(Relax, does_not_depend_on_threads_or_on_how_a_layer_is_cut) {
    const Surface surface(test::run(test::noise_volume({11, 11, 11}, 3, 2)).mesh);
    const auto one = relaxed(surface, surface.window.origin, 0.6),
               many = relaxed(surface, surface.window.origin, 0.6, 3);
    SlidingArray<Vec3> parts;
    parts.grow(one.end());
    for (std::uint32_t v = 0; v < one.end(); v += 1000)
        relax(surface.window, surface.neighbours, {v, std::min(v + 1000, one.end())}, 0.6, surface.window.origin, parts,
              1);
    for (std::uint32_t v = 0; v < one.end(); ++v) {
        EXPECT_EQ(one[v], many[v]);
        EXPECT_EQ(one[v], parts[v]);
    }
}

}  // namespace
}  // namespace regionmesh
