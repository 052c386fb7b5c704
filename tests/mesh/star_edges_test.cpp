#include "mesh/star_edges.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "mesh/strata.h"
#include "support/runs.h"
#include "support/shapes.h"

namespace regionmesh {
namespace {

std::set<Label> set_of(const LabelSet& set) { return {set.begin(), set.end()}; }

void expect_edges_of_all_stars(const Mesh& mesh) {
    StarEdges edges;
    test::for_vertices(mesh, [&](VertexId v) {
        std::set<VertexId> around;
        mesh.for_star(v, [&](FaceId f, int) { around.insert(mesh[f].vertices.begin(), mesh[f].vertices.end()); });
        around.erase(v);
        edges.gather(mesh, v);
        ASSERT_EQ(edges.ends().size(), around.size());
        ASSERT_EQ(edges.labels().size(), around.size());
        for (std::size_t n = 0; n < edges.ends().size(); ++n) {
            EXPECT_EQ(around.count(edges.ends()[n]), 1u);
            EXPECT_EQ(set_of(edges.labels()[n]), set_of(edge_labels(mesh, v, edges.ends()[n])));
        }
    });
}

TEST(StarEdges, have_the_labels_of_each_edge) {
    expect_edges_of_all_stars(test::run(test::grain_volume({12, 11, 10}, 9, 3)).mesh);
}

TEST(StarEdges, count_the_sides_of_the_box_where_the_surface_ends) {
    expect_edges_of_all_stars(
        test::run(test::grain_volume({9, 9, 9}, 5, 4), {.decimate = false, .cap = false, .background = {}}).mesh);
}

}  // namespace
}  // namespace regionmesh
