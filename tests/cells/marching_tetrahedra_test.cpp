#include "cells/marching_tetrahedra.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <set>

#include "base/triangle.h"
#include "support/nodes.h"

namespace regionmesh {
namespace {

using test::node;

Vec3 centroid_of(CornerSet set, const Step* corners) {
    Vec3 sum;
    for (int c = 0; c < 4; ++c)
        if (set >> c & 1) sum += node(corners[c]);
    return sum / std::popcount(set);
}

std::array<Vec3, 3> corners_of(const CaseFace& face, const Step* corners) {
    return {centroid_of(face.vertices[0], corners), centroid_of(face.vertices[1], corners),
            centroid_of(face.vertices[2], corners)};
}

/// Calls visit(tetrahedron's steps, labels, faces) for every tetrahedron of the cell and all labels 0 to 3.
template <class Visit>
void for_all_cases(Visit&& visit) {
    for (int kind = kFirstTetrahedron; kind < kKindCount; ++kind) {
        const auto& steps = kKinds[kind].steps;
        const TetrahedronCases cases = make_tetrahedron_cases(steps);
        for (Label n = 0; n < 256; ++n) {
            const std::array<Label, 4> label{n & 3, n >> 2 & 3, n >> 4 & 3, n >> 6};
            visit(steps, label, cases[tetrahedron_pattern(label[0], label[1], label[2], label[3])]);
        }
    }
}

std::size_t label_count(CornerSet set, const std::array<Label, 4>& label) {
    std::set<Label> labels;
    for (int c = 0; c < 4; ++c)
        if (set >> c & 1) labels.insert(label[c]);
    return labels.size();
}

TEST(MarchingTetrahedra, one_to_four_labels_make_0_1_2_5_12_faces) {
    for_all_cases([](const auto&, const auto& label, const auto& faces) {
        const std::size_t labels = label_count(15, label);
        const bool is_two_against_two = labels == 2 && std::ranges::count(label, label[0]) == 2;
        EXPECT_EQ(faces.size(), labels == 1 ? 0u : is_two_against_two ? 2u : labels == 2 ? 1u : labels == 3 ? 5u : 12u);
    });
}

TEST(MarchingTetrahedra, patterns_that_no_labels_make_are_empty) {
    const TetrahedronCases cases = make_tetrahedron_cases(kKinds[kFirstTetrahedron].steps);
    const auto made = std::ranges::count_if(cases, [](const auto& faces) { return !faces.empty(); });
    EXPECT_EQ(made, 14) << "fifteen ways to part four corners, and one of them has no face";
}

TEST(MarchingTetrahedra, vertices_are_simplices_whose_corners_all_differ) {
    for_all_cases([](const auto&, const auto& label, const auto& faces) {
        for (const CaseFace& face : faces)
            for (CornerSet set : face.vertices) {
                EXPECT_GE(std::popcount(set), 2);
                EXPECT_EQ(label_count(set, label), std::size_t(std::popcount(set)));
            }
    });
}

TEST(MarchingTetrahedra, a_face_separates_two_labels_and_its_vertices_see_both) {
    for_all_cases([](const auto&, const auto& label, const auto& faces) {
        for (const CaseFace& face : faces) {
            EXPECT_NE(label[face.first], label[face.second]);
            for (CornerSet set : face.vertices)
                for (int corner : {face.first, face.second}) {
                    bool sees = false;
                    for (int c = 0; c < 4; ++c) sees |= (set >> c & 1) && label[c] == label[corner];
                    EXPECT_TRUE(sees);
                }
        }
    });
}

TEST(MarchingTetrahedra, normal_points_from_first_to_second_corner) {
    for_all_cases([](const auto& steps, const auto&, const auto& faces) {
        for (const CaseFace& face : faces) {
            const auto p = corners_of(face, steps.data());
            const Vec3 normal = area_vector(p[0], p[1], p[2]);
            EXPECT_LT(dot(normal, node(steps[face.first]) - p[0]), -1e-9);
            EXPECT_GT(dot(normal, node(steps[face.second]) - p[0]), 1e-9);
        }
    });
}

TEST(MarchingTetrahedra, faces_have_quality_above_0_138) {
    for_all_cases([](const auto& steps, const auto&, const auto& faces) {
        for (const CaseFace& face : faces) {
            const auto p = corners_of(face, steps.data());
            EXPECT_GT(face_quality(p[0], p[1], p[2]), 0.138);
        }
    });
}

TEST(LatticeTriangle, one_to_three_labels_make_1_3_6_faces) {
    const TriangleCases cases = make_triangle_cases({0, 1, 3});
    EXPECT_EQ(cases[triangle_pattern(7, 7, 7)].size(), 1u);
    EXPECT_EQ(cases[triangle_pattern(7, 7, 8)].size(), 3u);
    EXPECT_EQ(cases[triangle_pattern(7, 8, 7)].size(), 3u);
    EXPECT_EQ(cases[triangle_pattern(8, 7, 7)].size(), 3u);
    EXPECT_EQ(cases[triangle_pattern(7, 8, 9)].size(), 6u);
}

TEST(LatticeTriangle, faces_tile_the_triangle_and_turn_as_it_does) {
    for (const std::array<Step, 3>& steps : {std::array<Step, 3>{0, 1, 3}, std::array<Step, 3>{4, 7, 6}}) {
        const std::array<Step, 4> corners{steps[0], steps[1], steps[2], 0};
        const Vec3 whole = area_vector(node(steps[0]), node(steps[1]), node(steps[2]));
        for (const auto& faces : make_triangle_cases(steps)) {
            if (faces.empty()) continue;
            Vec3 sum;
            for (const CaseFace& face : faces) {
                const auto p = corners_of(face, corners.data());
                const Vec3 area = area_vector(p[0], p[1], p[2]);
                EXPECT_GT(dot(area, whole), 0);
                EXPECT_GT(face_quality(p[0], p[1], p[2]), 0.138);
                sum += area;
            }
            EXPECT_NEAR(length(sum - whole), 0, 1e-12);
        }
    }
}

TEST(LatticeTriangle, three_labels_share_the_area_evenly) {
    const std::array<Step, 4> corners{0, 1, 3, 0};
    const TriangleCases cases = make_triangle_cases({0, 1, 3});
    std::array<double, 3> area{};
    for (const CaseFace& face : cases[triangle_pattern(0, 1, 2)]) {
        const auto p = corners_of(face, corners.data());
        area[face.first] += 0.5 * length(area_vector(p[0], p[1], p[2]));
    }
    for (double a : area) EXPECT_NEAR(a, 1.0 / 6, 1e-12);
}

/// Patches of all labels 0 to 3 at four corners, with the labels.
template <class Visit>
void for_all_patches(Visit&& visit) {
    const TetrahedronPatches patches = make_tetrahedron_patches();
    for (Label n = 0; n < 256; ++n) {
        const std::array<Label, 4> label{n & 3, n >> 2 & 3, n >> 4 & 3, n >> 6};
        visit(label, patches[tetrahedron_pattern(label[0], label[1], label[2], label[3])]);
    }
}

TEST(TetrahedronPatches, one_to_four_labels_make_none_a_triangle_or_quad_two_quads_and_a_triangle_six_quads) {
    for_all_patches([](const auto& label, const auto& patches) {
        const std::size_t labels = label_count(15, label);
        const bool is_two_against_two = labels == 2 && std::ranges::count(label, label[0]) == 2;
        const auto quads = std::ranges::count(patches, 4, &CasePatch::vertex_count);
        const auto triangles = std::ranges::count(patches, 3, &CasePatch::vertex_count);
        EXPECT_EQ(quads, labels == 4 ? 6 : labels == 3 ? 2 : is_two_against_two ? 1 : 0);
        EXPECT_EQ(triangles, labels == 3 || (labels == 2 && !is_two_against_two) ? 1 : 0);
        EXPECT_EQ(patches.size(), std::size_t(quads + triangles));
    });
}

TEST(TetrahedronPatches, steps_round_a_patch_lie_in_a_triangle_or_lead_between_two_or_to_the_middle) {
    for_all_patches([](const auto& label, const auto& patches) {
        for (const CasePatch& patch : patches)
            for (int n = 0; n < patch.vertex_count; ++n) {
                const CornerSet a = patch.vertices[n], b = patch.vertices[(n + 1) % patch.vertex_count];
                const CornerSet joint = a | b;
                EXPECT_NE(a, b);
                EXPECT_TRUE(std::popcount(joint) == 3 || (std::popcount(a) >= 3 && std::popcount(b) >= 3));
                EXPECT_GE(label_count(joint, label), 2u);
            }
    });
}

TEST(TetrahedronPatches, a_cut_keeps_the_rim_and_a_turn_turns_it) {
    for_all_patches([](const auto&, const auto& patches) {
        for (const CasePatch& patch : patches)
            for (int start = 0; start < patch.vertex_count - 2; ++start)
                for (bool turn : {false, true}) {
                    std::array<CaseFace, 2> faces;
                    const int count = patch.cut(start, turn, faces);
                    ASSERT_EQ(count, patch.vertex_count - 2);
                    std::multiset<std::pair<CornerSet, CornerSet>> steps;
                    for (int f = 0; f < count; ++f) {
                        EXPECT_EQ(faces[f].first, patch.first);
                        EXPECT_EQ(faces[f].second, patch.second);
                        for (int n = 0; n < 3; ++n)
                            steps.insert({faces[f].vertices[n], faces[f].vertices[(n + 1) % 3]});
                    }
                    for (int n = 0; n < patch.vertex_count; ++n) {
                        const CornerSet a = patch.vertices[n], b = patch.vertices[(n + 1) % patch.vertex_count];
                        EXPECT_EQ(steps.count(turn ? std::pair(b, a) : std::pair(a, b)), 1u);
                    }
                    if (count == 2) {
                        const CornerSet a = patch.vertices[start], b = patch.vertices[start + 2];
                        EXPECT_TRUE(steps.contains({a, b}) && steps.contains({b, a}))
                            << "the diagonal begins at `start`";
                    }
                }
    });
}

TEST(TetrahedronPatches, normal_points_from_first_to_second_in_any_tetrahedron) {
    // A bent one, and its mirror image.
    const std::array<Vec3, 4> corners{{{0.1, 0, 0}, {1, 0.2, 0}, {0, 1, 0.3}, {0.2, 0.1, 1}}};
    for (double mirror : {1.0, -1.0})
        for_all_patches([&](const auto&, const auto& patches) {
            const auto at = [&](CornerSet set) {
                Vec3 sum;
                for (int c = 0; c < 4; ++c)
                    if (set >> c & 1) sum += Vec3{mirror * corners[c].x, corners[c].y, corners[c].z};
                return sum / std::popcount(set);
            };
            const bool is_mirrored = dot(area_vector(at(1), at(2), at(4)), at(8) - at(1)) < 0;
            for (const CasePatch& patch : patches)
                for (int start = 0; start < patch.vertex_count - 2; ++start) {
                    std::array<CaseFace, 2> faces;
                    const int count = patch.cut(start, patch.turns != is_mirrored, faces);
                    for (int f = 0; f < count; ++f) {
                        const Vec3 p = at(faces[f].vertices[0]);
                        const Vec3 normal = area_vector(p, at(faces[f].vertices[1]), at(faces[f].vertices[2]));
                        EXPECT_LT(dot(normal, at(CornerSet(1 << patch.first)) - p), 0);
                        EXPECT_GT(dot(normal, at(CornerSet(1 << patch.second)) - p), 0);
                    }
                }
        });
}

TEST(TetrahedronPatches, better_cut_gives_the_better_worst_quality_and_the_first_in_a_draw) {
    EXPECT_EQ(better_cut({{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}}), 0);
    EXPECT_EQ(better_cut({{{0, 0, 0}, {3, 1, 0}, {6, 0, 0}, {3, -1, 0}}}), 1)
        << "a flat rhombus is cut along its short diagonal";
    EXPECT_EQ(better_cut({{{0, 1, 0}, {3, 0, 0}, {0, -1, 0}, {-3, 0, 0}}}), 0);
}

TEST(TrianglePatches, one_to_three_labels_make_a_triangle_a_triangle_and_a_quad_three_quads) {
    const TrianglePatches patches = make_triangle_patches();
    const auto shapes = [&](Label a, Label b, Label c) {
        std::multiset<int> counts;
        for (const CasePatch& patch : patches[triangle_pattern(a, b, c)]) counts.insert(patch.vertex_count);
        return counts;
    };
    EXPECT_EQ(shapes(7, 7, 7), (std::multiset<int>{3}));
    for (const auto& [a, b, c] : {std::array<Label, 3>{7, 7, 8}, {7, 8, 7}, {8, 7, 7}})
        EXPECT_EQ(shapes(a, b, c), (std::multiset<int>{3, 4}));
    EXPECT_EQ(shapes(7, 8, 9), (std::multiset<int>{4, 4, 4}));
    for (unsigned pattern : {1u, 2u, 4u}) EXPECT_TRUE(patches[pattern].empty()) << "no labels make it";
}

TEST(MarchingTetrahedra, cone_cuts_share_one_vertex) {
    for (int kind = kFirstTetrahedron; kind < kKindCount; ++kind) {
        const TetrahedronCases cases = make_tetrahedron_cases(kKinds[kind].steps, QuadCuts::kCones);
        const TetrahedronCases usual = make_tetrahedron_cases(kKinds[kind].steps);
        for (std::size_t pattern = 0; pattern < cases.size(); ++pattern) {
            EXPECT_EQ(cases[pattern].size(), usual[pattern].size());
            if (cases[pattern].empty()) continue;
            int shared = 0;
            for (CornerSet vertex = 1; vertex < 16; ++vertex)
                shared += std::all_of(cases[pattern].begin(), cases[pattern].end(), [&](const CaseFace& face) {
                    return std::count(face.vertices.begin(), face.vertices.end(), vertex) > 0;
                });
            EXPECT_GE(shared, 1) << "pattern " << pattern;
        }
    }
}

}  // namespace
}  // namespace regionmesh
