#include "cells/compact_cells.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "cells/table/compact_search.h"
#include "regionmesh/census.h"
#include "support/runs.h"
#include "support/strata_list.h"

namespace regionmesh {
namespace {

using cell_table::AnyPosition;
using cell_table::CellFace;
using Edge = std::pair<NodeSet, NodeSet>;

constexpr std::string_view kTable =
#include "cells/compact_table.inc"
    ;

ReconstructOptions compact() {
    ReconstructOptions options = test::plain();
    options.cells = CellKind::kCompact;
    return options;
}

std::string text_of(const Partition& labels) {
    std::string text;
    for (int label : labels) text += std::to_string(label);
    return text;
}

std::vector<CellFace> faces_of(const Partition& labels) {
    std::array<Label, 8> names{};
    std::copy(labels.begin(), labels.end(), names.begin());
    std::vector<CellFace> faces;
    CompactCells::get().for_each_face(names, [&](const CompactFace& face) {
        CellFace made{{}, labels[face.first], labels[face.second]};
        for (int n = 0; n < 3; ++n) made.vertices[n] = kCellSimplices[face.vertices[n]];
        faces.push_back(made);
    });
    return faces;
}

/// The curves on the sides of the cell: edges of the faces with both ends in one side.
std::set<Edge> curves_of(const std::vector<CellFace>& faces) {
    std::set<Edge> curves;
    for (const CellFace& face : faces)
        for (int n = 0; n < 3; ++n) {
            const NodeSet a = face.vertices[n], b = face.vertices[(n + 1) % 3];
            if (cell_table::sides_of(a) & cell_table::sides_of(b)) curves.insert(std::minmax(a, b));
        }
    return curves;
}

/// What the face rule makes of the curves of the tetrahedra: the two edges at a diagonal become one.
std::set<Edge> curves_by_rule(const Partition& labels) {
    std::set<Edge> curves = curves_of(cell_table::tetrahedra_faces(labels));
    for (NodeSet diagonal : kCellSimplices) {
        if (std::popcount(unsigned{diagonal}) != 2 || std::popcount(cell_table::sides_of(diagonal)) != 1) continue;
        if (!drops_diagonal(diagonal, labels)) continue;
        std::vector<NodeSet> ends;
        for (const Edge& edge : std::set<Edge>(curves))
            if (edge.first == diagonal || edge.second == diagonal) {
                ends.push_back(edge.first == diagonal ? edge.second : edge.first);
                curves.erase(edge);
            }
        EXPECT_EQ(ends.size(), 2u);
        curves.insert(std::minmax(ends[0], ends[1]));
    }
    return curves;
}

TEST(CompactCells, the_search_finds_the_table_again) { EXPECT_EQ(cell_table::compact_table(), kTable); }

TEST(CompactCells, faces_never_meet_wherever_vertices_go_in_their_simplices) {
    AnyPosition positions;
    for_each_partition([&](const Partition& labels) {
        if (testing::Test::HasFailure()) return;
        SCOPED_TRACE("corners " + text_of(labels));
        const std::vector<CellFace> faces = faces_of(labels);
        for (std::size_t f = 0; f < faces.size(); ++f)
            for (std::size_t g = 0; g < f; ++g) EXPECT_TRUE(positions.are_apart(faces[f].vertices, faces[g].vertices));
    });
}

TEST(CompactCells, cells_that_share_a_side_have_the_same_curves_there) {
    for_each_partition([&](const Partition& labels) {
        if (testing::Test::HasFailure()) return;
        SCOPED_TRACE("corners " + text_of(labels));
        EXPECT_EQ(curves_of(faces_of(labels)), curves_by_rule(labels));
    });
}

TEST(CompactCells, all_partitions_have_the_strata_of_the_tetrahedra) {
    double worst = 1;
    for_each_partition([&](const Partition& labels) {
        if (testing::Test::HasFailure()) return;
        SCOPED_TRACE("corners " + text_of(labels));
        test::ArrayVolume cell({2, 2, 2}, {labels.begin(), labels.end()});
        const Reconstruction made = test::run(cell, compact());
        test::expect_sound(made.report.check);
        test::expect_generic(made.mesh);
        test::expect_same_strata(test::list_strata(made.mesh), test::list_strata(test::run(cell).mesh));
        EXPECT_EQ(made.report.initial_faces, made.mesh.face_count());
        worst = std::min(worst, made.report.check.quality.min);
        double volume = 0;
        for (const RegionReport& region : made.report.check.regions) volume += region.volume;
        EXPECT_NEAR(volume, 1, 1e-12);
    });
    EXPECT_GT(worst, 0.105);
}

TEST(CompactCells, faces_and_labels_of_a_cell_are_counted) {
    for_each_partition([&](const Partition& partition) {
        std::array<Label, 8> labels{};
        for (int n = 0; n < 8; ++n) labels[n] = 7 + 3 * partition[n];
        const CompactCells::Counts counts = CompactCells::get().counts(labels);
        EXPECT_EQ(counts.labels, static_cast<int>(std::set(partition.begin(), partition.end()).size()));
        int faces = 0;
        CompactCells::get().for_each_face(labels, [&](const CompactFace& face) {
            ++faces;
            EXPECT_NE(labels[face.first], labels[face.second]);
        });
        EXPECT_EQ(counts.faces, faces);
    });
}

TEST(CompactCells, volumes_are_sound_and_counted_before_they_are_meshed) {
    for (std::uint32_t labels : {2, 3, 5, 40})
        for (const test::Size& size : {test::Size{7, 6, 8}, test::Size{2, 9, 3}}) {
            SCOPED_TRACE(std::to_string(labels) + " labels");
            test::ArrayVolume noise = test::noise_volume(size, labels, 3 * labels);
            const Reconstruction made = test::run(noise, compact());
            test::expect_sound(made.report.check);
            test::expect_same_strata(test::list_strata(made.mesh), test::list_strata(test::run(noise).mesh));
            noise.rewind();
            const Census census = count_labels(noise, {.background = {}, .cells = CellKind::kCompact});
            EXPECT_EQ(census.face_count, made.mesh.face_count());
        }
}

TEST(CompactCells, smoothed_and_decimated_models_keep_every_sample) {
    for (std::uint32_t labels : {2, 12}) {
        test::ArrayVolume grains = test::grain_volume({24, 22, 20}, labels, 5);
        ReconstructOptions options = test::reduced(0.9);
        options.cells = CellKind::kCompact;
        options.smooth = {};
        const Reconstruction made = test::run(grains, options);
        test::expect_sound(made.report.check);
        EXPECT_LT(made.report.final_faces, made.report.initial_faces / 2);
        ASSERT_TRUE(made.report.samples);
        EXPECT_EQ(made.report.samples->wrong, 0u);
    }
}

TEST(CompactCells, have_less_than_half_the_faces_of_tetrahedra) {
    test::ArrayVolume ball = test::ball_volume({24, 24, 24}, 9.3);
    ReconstructOptions open = compact();
    open.cap = false;
    const std::uint64_t faces = test::run(ball, open).report.initial_faces;
    open.cells = CellKind::kTetrahedra;
    EXPECT_LT(2 * faces, test::run(ball, open).report.initial_faces);
}

}  // namespace
}  // namespace regionmesh
