#include "mesh/strata.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "support/runs.h"
#include "support/shapes.h"
#include "support/strata_list.h"

namespace regionmesh {
namespace {

using test::run;
using test::Stratum;
using testing::UnorderedElementsAre;

std::vector<Label> labels_of(const LabelSet& set) { return {set.begin(), set.end()}; }

VertexId vertex_at(const Mesh& mesh, Vec3 place) {
    VertexId found = kNoVertex;
    test::for_vertices(mesh, [&](VertexId v) {
        if (mesh.position(v) == place) found = v;
    });
    return found;
}

TEST(LabelSet, holds_each_label_once) {
    LabelSet set;
    for (Label label : {3u, 1u, 3u, 2u, 1u}) set.add(label);
    EXPECT_THAT(labels_of(set), testing::ElementsAre(3, 1, 2));
    EXPECT_TRUE(set.contains(2));
    EXPECT_FALSE(set.contains(4));
}

TEST(LabelSet, stops_counting_at_its_capacity) {
    LabelSet set;
    for (Label label = 0; label < 40; ++label) set.add(label);
    EXPECT_EQ(set.size(), LabelSet::kCapacity);
}

TEST(Strata, inside_an_interface_there_are_two_labels) {
    const Mesh mesh = test::octahedron();
    EXPECT_THAT(labels_of(vertex_labels(mesh, VertexId{0})), UnorderedElementsAre(0, 1));
    EXPECT_THAT(labels_of(edge_labels(mesh, VertexId{0}, VertexId{2})), UnorderedElementsAre(0, 1));
}

TEST(Strata, an_edge_of_the_box_has_two_faces_and_is_a_line) {
    const Mesh mesh = run(test::solid_volume({3, 3, 3})).mesh;
    const VertexId u = vertex_at(mesh, {1, 0, 0}), v = vertex_at(mesh, {2, 0, 0});
    EXPECT_THAT(labels_of(edge_labels(mesh, u, v)), UnorderedElementsAre(0, exterior(2), exterior(4)));
    EXPECT_EQ(vertex_labels(mesh, u).size(), 3);
    EXPECT_EQ(vertex_labels(mesh, v).size(), 4) << "a corner of the box is a point";
}

TEST(Strata, a_diagonal_between_two_edges_of_the_box_is_no_line) {
    const Mesh mesh = run(test::solid_volume({2, 2, 3})).mesh;
    EXPECT_EQ(edge_labels(mesh, vertex_at(mesh, {0, 0, 1}), vertex_at(mesh, {1, 0, 2})).size(), 2);
}

TEST(Strata, the_rim_of_an_open_surface_counts_the_sides_it_lies_on) {
    const Mesh mesh = run(test::TextVolume({{"00", "00"}, {"11", "11"}}),
                          {.cells = CellKind::kTetrahedra, .decimate = false, .cap = false, .background = {}})
                          .mesh;
    const VertexId corner = vertex_at(mesh, {0, 0, 0.5}), side = vertex_at(mesh, {0.5, 0, 0.5});
    EXPECT_THAT(labels_of(vertex_labels(mesh, corner)), UnorderedElementsAre(0, 1, exterior(0), exterior(2)));
    EXPECT_THAT(labels_of(edge_labels(mesh, corner, side)), UnorderedElementsAre(0, 1, exterior(2)));
}

TEST(Strata, an_edge_across_an_open_surface_from_rim_to_rim_is_no_line) {
    const Mesh mesh =
        run(test::TextVolume({{"00", "00"}, {"11", "11"}}), {.decimate = false, .cap = false, .background = {}}).mesh;
    test::for_faces(mesh, [&](FaceId f) {
        const auto& v = mesh[f].vertices;
        for (int n = 0; n < 3; ++n) {
            const bool is_on_rim = (mesh[v[n]].sides & mesh[v[(n + 1) % 3]].sides) != 0;
            EXPECT_EQ(edge_labels(mesh, v[n], v[(n + 1) % 3]).size(), is_on_rim ? 3 : 2);
        }
    });
}

TEST(Strata, three_regions_at_an_edge_make_a_line) {
    const Mesh mesh = test::shape({{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {-1, 1, 0}, {-1, -1, 0}},
                                  {{{0, 1, 2}, 0, 1}, {{0, 1, 3}, 1, 2}, {{0, 1, 4}, 2, 0}});
    EXPECT_EQ(edge_labels(mesh, VertexId{0}, VertexId{1}).size(), 3);
}

TEST(StrataList, a_box_has_a_region_of_six_interfaces_twelve_lines_and_eight_points) {
    const test::StrataList list = test::list_strata(run(test::solid_volume({4, 3, 5})).mesh);
    std::array<int, 5> count{};
    for (const auto& [labels, stratum] : list) {
        ++count[labels.size()];
        EXPECT_EQ(stratum, (Stratum{1, labels.size() == 3 ? -1 : 1}));
    }
    EXPECT_EQ(count, (std::array{0, 0, 6, 12, 8}));
}

TEST(StrataList, a_closed_line_has_euler_characteristic_zero) {
    // A rod of 1 half in 2 and half in 3: their common rim is a loop.
    const test::TextVolume::Section two{"2222", "2112", "2112", "2222"}, three{"3333", "3113", "3113", "3333"},
        low{"2222", "2222", "2222", "2222"}, high{"3333", "3333", "3333", "3333"};
    const Reconstruction made = run(test::TextVolume({low, two, three, high}));
    const auto dense = [&](InputLabel wanted) {
        Label found = 0;
        for (Label label = 0; label < made.labels.size(); ++label)
            if (made.labels.input(label) == wanted) found = label;
        return found;
    };
    std::vector<Label> line{dense(1), dense(2), dense(3)};
    std::ranges::sort(line);
    EXPECT_EQ(test::list_strata(made.mesh).at(line), (Stratum{1, 0}));
}

}  // namespace
}  // namespace regionmesh
