#include <gtest/gtest.h>

#include <numeric>

#include "regionmesh/check.h"
#include "regionmesh/shapes.h"
#include "support/runs.h"

namespace regionmesh {
namespace {

template <std::size_t kBins>
std::uint64_t total(const Histogram<kBins>& histogram) {
    return std::accumulate(histogram.counts.begin(), histogram.counts.end(), std::uint64_t{0});
}

/// The corner of a cube, cut off: three right angles between faces, three of acos(1/sqrt(3)).
Mesh corner() {
    Mesh mesh;
    const VertexId o = mesh.add_vertex({0, 0, 0}), x = mesh.add_vertex({1, 0, 0}), y = mesh.add_vertex({0, 1, 0}),
                   z = mesh.add_vertex({0, 0, 1});
    for (const auto& [a, b, c] : {std::array{o, y, x}, std::array{o, x, z}, std::array{o, z, y}, std::array{x, y, z}})
        mesh.add_face(a, b, c, Label{0}, Label{1});
    return mesh;
}

TEST(MeasureShapes, of_a_corner_are_known) {
    const ShapeReport shapes = measure_shapes(corner());
    EXPECT_EQ(shapes.shortest_edge, 1);
    EXPECT_DOUBLE_EQ(shapes.longest_edge, std::sqrt(2.0));
    EXPECT_NEAR(shapes.least_dihedral, 54.7356, 1e-4);
    EXPECT_DOUBLE_EQ(shapes.largest_ratio, std::sqrt(2.0));
    EXPECT_EQ(shapes.largest_valence, 3u);
    EXPECT_EQ(total(shapes.lengths), 6u);
    EXPECT_EQ(total(shapes.dihedrals), 12u);  // inside and outside
    EXPECT_EQ(shapes.dihedrals.counts[5], 3u);
    EXPECT_EQ(shapes.dihedrals.counts[30], 3u);
    EXPECT_EQ(shapes.valences.counts[3], 4u);
    EXPECT_EQ(shapes.ratios.counts[0], 4u);
}

TEST(MeasureShapes, are_the_same_for_any_number_of_threads) {
    const Mesh mesh = test::run(test::grain_volume({30, 28, 26}, 12, 5)).mesh;
    const ShapeReport one = measure_shapes(mesh, 1), four = measure_shapes(mesh, 4);
    EXPECT_EQ(total(one.valences), mesh.vertex_count());
    EXPECT_EQ(one.least_dihedral, four.least_dihedral);
    EXPECT_EQ(one.dihedrals.counts, four.dihedrals.counts);
    EXPECT_EQ(one.lengths.counts, four.lengths.counts);
}

TEST(MeasureShapes, of_nothing_are_nothing) { EXPECT_EQ(measure_shapes(Mesh()).longest_edge, 0); }

}  // namespace
}  // namespace regionmesh
