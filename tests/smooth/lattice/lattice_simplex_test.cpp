#include "smooth/lattice/lattice_simplex.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>

#include "base/exact_predicates.h"
#include "cells/marching_tetrahedra.h"
#include "cells/strip_mesher.h"
#include "mesh/exact_ray.h"
#include "mesh/face_meeting.h"
#include "regionmesh/check.h"
#include "support/cone_chunks.h"
#include "support/crossings.h"
#include "support/lattice_simplices.h"
#include "support/runs.h"

namespace regionmesh {
namespace {

constexpr double kMargin = 1e-3;  // positions nearer to the ends than any that the filter makes

/// Weights anywhere inside, often at the margin.
Barycentric random_weights(std::mt19937_64& random, int node_count, double margin = kMargin) {
    std::uniform_real_distribution<double> uniform(0, 1);
    Barycentric weights{};
    double sum = 0;
    for (int n = 0; n < node_count; ++n) {
        const double u = uniform(random);
        sum += weights[n] = u < 0.4 ? 0 : u * u;
    }
    if (sum == 0) sum = weights[0] = 1;
    for (double& weight : weights) weight /= sum;
    return clamp_inside(weights, node_count, margin);
}

void shake(Mesh& mesh, const LatticeFrame& frame, CellKind cells, std::mt19937_64& random) {
    const LatticeMargins margins{kMargin, cells == CellKind::kCompact ? CompactCells::kInnerMargin : 0};
    for (std::uint32_t v = 0; v < mesh.vertex_end(); ++v) {
        const LatticeSimplex simplex = test::simplex_at(mesh.position(VertexId{v}), frame);
        mesh[VertexId{v}].position = position_in(
            simplex,
            rounded(random_weights(random, simplex.node_count(), margins.of(simplex.kind)), simplex.node_count()),
            frame);
    }
}

/// The label of each inner sample, from the surface alone: of its region a line to the outside is left once more than
/// it is entered.
void expect_samples_inside(const Mesh& mesh, const test::ArrayVolume& volume, const LatticeFrame& frame) {
    const SortedFaceTree tree(mesh, 1);
    const ExactRay ray(mesh, tree);
    const test::Size size = volume.size();
    for (std::uint32_t z = 1; z + 1 < size[2]; ++z)
        for (std::uint32_t y = 1; y + 1 < size[1]; ++y)
            for (std::uint32_t x = 1; x + 1 < size[0]; ++x) {
                const Vec3 at{frame.origin.x + x * frame.spacing.x, frame.origin.y + y * frame.spacing.y,
                              frame.origin.z + z * frame.spacing.z};
                const auto passed = ray.faces_passed(at, [](FaceId) { return true; });
                ASSERT_TRUE(passed.has_value());
                std::map<Label, int> left;
                for (const FacePassed& pass : *passed) {
                    const auto& [first, second] = mesh[pass.face].labels;
                    left[first] += pass.leaves_first ? 1 : -1;
                    left[second] -= pass.leaves_first ? 1 : -1;
                }
                for (const auto& [label, count] : left) {
                    if (is_exterior(label)) continue;
                    const bool is_own = label == volume.at(x, y, z);
                    EXPECT_EQ(count, is_own ? 1 : 0) << "sample " << x << " " << y << " " << z;
                }
            }
}

TEST(LatticeFrame, with_sections_twice_as_far_apart_is_anisotropic_up_to_rounding) {
    EXPECT_TRUE((LatticeFrame{.spacing = {0.5, 1 - 1e-7, 0.5}}.is_anisotropic()));
    EXPECT_FALSE((LatticeFrame{.spacing = {1, 1.5, 1}}.is_anisotropic()));
}

TEST(LatticeSimplex, comes_with_each_vertex_from_the_mesher_whatever_the_sweep) {
    test::ArrayVolume volume = test::noise_volume({6, 5, 4}, 4, 3);
    volume.lattice().spacing = {0.3, 1, 7.1};
    volume.lattice().origin = {-3.7, 1e4, 0.125};
    const Lattice& lattice = volume.info().lattice;
    const LatticeFrame frame{lattice.origin, lattice.spacing};
    for (const Sweep& sweep : {kSweepX, kSweepY, kSweepZ})
        for (const CellKind cells : {CellKind::kCompact, CellKind::kTetrahedra}) {
            std::set<int> kinds;
            for (const Chunk& chunk : test::cone_chunks(volume, cells, sweep)) {
                ASSERT_EQ(chunk.simplices.size(), chunk.vertices.size());
                for (std::size_t v = 0; v < chunk.vertices.size(); ++v) {
                    const LatticeSimplex simplex = simplex_of(chunk.simplices[v]);
                    EXPECT_EQ(centroid_in(simplex, frame), chunk.vertices[v].position);
                    kinds.insert(simplex.kind);
                }
            }
            EXPECT_GT(kinds.size(), cells == CellKind::kTetrahedra ? 24u : 12u);
        }
}

TEST(LatticeSimplex, clamping_keeps_all_weights_above_the_margin) {
    for (int count = 2; count <= 4; ++count)
        for (const Barycentric& weights : {Barycentric{2, -1, 0, 0}, Barycentric{-5, 3, 3, 0}, Barycentric{1, 0, 0, 0},
                                           Barycentric{-1, -1, -1, 4}}) {
            Barycentric used{};
            double sum = 0;
            for (int n = 0; n < count; ++n) sum += used[n] = weights[n];
            used[0] += 1 - sum;
            const Barycentric inside = clamp_inside(used, count, 0.03);
            double total = 0;
            for (int n = 0; n < count; ++n) {
                EXPECT_GE(inside[n], 0.03);
                total += inside[n];
            }
            EXPECT_NEAR(total, 1, 1e-12);
        }
    const Barycentric kept = clamp_inside({0.2, 0.3, 0.5, 0}, 3, 0.03);
    EXPECT_NEAR(kept[0], 0.2, 1e-15);
    EXPECT_NEAR(kept[1], 0.3, 1e-15);
}

TEST(LatticeSimplex, positions_lie_exactly_in_the_simplex_at_unit_spacing) {
    std::mt19937_64 random(7);
    const LatticeFrame frame;
    for (int kind = 1; kind < kKindCount; ++kind)
        for (int round = 0; round < 200; ++round) {
            const LatticeSimplex simplex{{1000, 3, 77}, static_cast<std::uint8_t>(kind)};
            const Vec3 d =
                position_in(simplex, rounded(random_weights(random, simplex.node_count()), simplex.node_count()),
                            frame) -
                simplex.base;
            // Axes ordered by the step in which the chain first has them: offsets fall, and are equal within a step.
            const SimplexKind& chain = kKinds[kind];
            for (int a = 0; a < 3; ++a)
                for (int b = 0; b < 3; ++b) {
                    int first_a = 9, first_b = 9;
                    for (int n = chain.node_count - 1; n > 0; --n) {
                        if (chain.steps[n] >> a & 1) first_a = n;
                        if (chain.steps[n] >> b & 1) first_b = n;
                    }
                    if (first_a == first_b) {
                        EXPECT_EQ(d[a], d[b]);
                    }
                    if (first_a < first_b) {
                        EXPECT_GT(d[a], d[b]);
                    }
                    if (first_a == 9) {
                        EXPECT_EQ(d[a], 0);
                    }
                }
            for (int a = 0; a < 3; ++a) EXPECT_LT(d[a], 1);
        }
}

/// Inside the simplex that some corners of a tetrahedron span.
Vec3 random_place(const std::array<Step, 4>& corners, unsigned set, std::mt19937_64& random) {
    LatticeSimplex simplex;
    std::array<Step, 4> chain{};
    int count = 0;
    for (int c = 0; c < 4; ++c) {
        if (!(set >> c & 1)) continue;
        if (count == 0)
            for (int axis = 0; axis < 3; ++axis) simplex.base[axis] = corners[c] >> axis & 1;
        chain[count] = corners[c] - (count == 0 ? corners[c] : 0);
        ++count;
    }
    int first = 0;
    while (!(set >> first & 1)) ++first;
    for (int n = 1; n < count; ++n) chain[n] -= corners[first];
    simplex.kind = static_cast<std::uint8_t>(kind_of(chain[1], chain[2], chain[3]));
    return position_in(simplex, rounded(random_weights(random, count), count), {});
}

/// Random positions in every case of every tetrahedron: no two of its faces meet outside what they share.
TEST(LatticeSimplex, faces_of_a_tetrahedron_never_cross) {
    std::mt19937_64 random(11);
    for (int t = 0; t < 6; ++t) {
        const std::array<Step, 4> corners = kKinds[kFirstTetrahedron + t].steps;
        const TetrahedronCases cases = make_tetrahedron_cases(corners, QuadCuts::kCones);
        for (const std::vector<CaseFace>& faces : cases)
            for (int round = 0; round < 300; ++round) {
                std::array<Vec3, 16> place{};
                for (unsigned set = 1; set < 16; ++set) {
                    place[set] = random_place(corners, set, random);
                }
                for (std::size_t f = 0; f < faces.size(); ++f)
                    for (std::size_t g = 0; g < f; ++g) {
                        const auto placed = [&](const CaseFace& face) {
                            const auto& v = face.vertices;
                            return PlacedFace{{VertexId{v[0]}, VertexId{v[1]}, VertexId{v[2]}},
                                              {place[v[0]], place[v[1]], place[v[2]]}};
                        };
                        ASSERT_FALSE(meet_outside_shared(placed(faces[f]), placed(faces[g])));
                    }
            }
    }
}

class LatticeSimplexOf : public testing::TestWithParam<CellKind> {};

/// All 4,140 partitions of the eight samples of a cell, caps included.
TEST_P(LatticeSimplexOf, surfaces_of_all_cells_stay_sound) {
    std::mt19937_64 random(13);
    std::uint32_t partitions = 0;
    for_each_partition([&](const Partition& labels) {
        ++partitions;
        Mesh mesh;
        Chunk chunk;
        const std::vector<Label> dense(labels.begin(), labels.end());
        StripMesher mesher({.size = {2, 2, 2}}, kSweepZ, {.cells = GetParam(), .cuts = QuadCuts::kCones});
        mesher.mesh(std::span(dense).first(4), std::span(dense).last(4), chunk);
        for (const ChunkVertex& vertex : chunk.vertices) mesh.add_vertex(vertex.position, vertex.sides);
        for (const ChunkFace& face : chunk.faces)
            mesh.add_face(VertexId{face.vertices[0]}, VertexId{face.vertices[1]}, VertexId{face.vertices[2]},
                          face.labels[0], face.labels[1]);
        shake(mesh, {}, GetParam(), random);
        const CheckReport report = check(mesh, {.threads = 1});
        if (report.violation_count() > 0) test::expect_sound(report);
    });
    EXPECT_EQ(partitions, 4140u);
}

TEST_P(LatticeSimplexOf, any_positions_inside_keep_every_sample) {
    std::mt19937_64 random(17);
    const LatticeFrame frames[] = {{}, {{-7.3, 100.1, 0.7}, {0.7, 1.3, 5.1}}};
    for (const LatticeFrame& frame : frames)
        for (std::uint32_t labels : {2u, 3u, 12u}) {
            test::ArrayVolume volume = test::noise_volume({6, 6, 6}, labels, labels);
            volume.lattice().spacing = frame.spacing;
            volume.lattice().origin = frame.origin;
            Mesh mesh = test::mesh_of(test::cone_chunks(volume, GetParam()));
            shake(mesh, frame, GetParam(), random);
            EXPECT_TRUE(test::crossings_in(mesh).empty());
            test::expect_sound(check(mesh));
            expect_samples_inside(mesh, volume, frame);
        }
}

INSTANTIATE_TEST_SUITE_P(cells, LatticeSimplexOf, testing::Values(CellKind::kTetrahedra, CellKind::kCompact),
                         [](const auto& info) { return info.param == CellKind::kCompact ? "compact" : "tetrahedra"; });

}  // namespace
}  // namespace regionmesh
