#include "compare/strata_tree.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

#include "compare/distance.h"
#include "support/labels.h"

namespace regionmesh {
namespace {

LabelTable labels_up_to(InputLabel count) {
    LabelTable labels;
    for (InputLabel label = 0; label < count; ++label) labels.dense(label);
    return labels;
}

/// Faces anywhere, with any two of six labels; a third of them far from the others, some without area.
Mesh scattered_faces(std::uint32_t count, std::uint64_t seed, Vec3 middle = {}) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> unit(-1, 1);
    const auto any = [&] { return Vec3{unit(random), unit(random), unit(random)}; };
    Mesh mesh;
    for (std::uint32_t f = 0; f < count; ++f) {
        const Vec3 corner = middle + (f % 3 == 0 ? 20 : 3) * any();
        const VertexId a = mesh.add_vertex(corner), b = mesh.add_vertex(corner + 0.5 * any()),
                       c = f % 17 == 0 ? b : mesh.add_vertex(corner + 0.5 * any());
        const Label first = random() % 5;
        mesh.add_face(a, b, c, first, first + 1 + random() % (6 - first - 1));
    }
    return mesh;
}

/// What the tree should find, by looking at all.
template <class Wanted>
double least_squared(const SortedStrata& sorted, Vec3 p, Wanted&& wanted) {
    double least = HUGE_VAL;
    for (const Stratum& stratum : sorted.strata)
        for (std::uint32_t n = stratum.begin; wanted(stratum) && n < stratum.end; ++n) {
            const auto& [a, b, c] = sorted.simplices[n];
            least = std::min(least, squared_distance(p, {sorted.points[a], sorted.points[b], sorted.points[c]}));
        }
    return least;
}

class Soup : public testing::TestWithParam<std::uint32_t> {};
INSTANTIATE_TEST_SUITE_P(StrataTree, Soup, testing::Values(1, 7, 65, 700, 3000));

TEST_P(Soup, is_searched_as_if_one_looked_at_every_face) {
    for (const Vec3 middle : {Vec3{}, Vec3{1e5, -1e5, 3e5}}) {
        const Mesh mesh = scattered_faces(GetParam(), GetParam(), middle);
        const LabelTable table = labels_up_to(6);
        const CommonLabels labels(table, table);
        const SortedStrata sorted = interfaces_of({mesh, labels, 0, {}}, 1);
        const StrataTree tree(sorted, 1);
        std::mt19937_64 random(1);
        std::uniform_real_distribution<double> unit(-1, 1);
        Nearest guess;
        for (int n = 0; n < 200; ++n) {
            const double reach = n % 10 == 0 ? 1000 : n % 2 ? 20 : 3;
            const Vec3 p = middle + reach * Vec3{unit(random), unit(random), unit(random)};
            const double all = least_squared(sorted, p, [](const Stratum&) { return true; });
            EXPECT_DOUBLE_EQ(tree.nearest(p).squared, all);
            guess = tree.nearest(p, guess);
            EXPECT_DOUBLE_EQ(guess.squared, all) << "from the one before";
            const Label label = n % 6;
            EXPECT_DOUBLE_EQ(tree.nearest_of_label(p, label).squared,
                             least_squared(sorted, p, [&](const Stratum& s) { return s.contains(label); }));
            const std::uint32_t stratum = n % sorted.strata.size();
            const Nearest found = tree.nearest_of_stratum(p, stratum);
            EXPECT_DOUBLE_EQ(found.squared,
                             least_squared(sorted, p, [&](const Stratum& s) { return &s == &sorted.strata[stratum]; }));
            EXPECT_EQ(found.stratum, stratum);
        }
    }
}

TEST(StrataTree, finds_nothing_that_is_no_nearer_than_what_is_known) {
    const Mesh mesh = scattered_faces(700, 3);
    const LabelTable table = labels_up_to(6);
    const CommonLabels labels(table, table);
    const SortedStrata sorted = interfaces_of({mesh, labels, 0, {}}, 1);
    const StrataTree tree(sorted, 1);
    const Vec3 p{1, 2, 3};
    const Nearest found = tree.nearest(p), far = tree.nearest({20, 20, 20});
    const double least = found.squared;
    for (const Nearest& guess : {Nearest{}, found, far}) {
        EXPECT_EQ(tree.nearest(p, guess, 1.001 * least).simplex, found.simplex);
        EXPECT_EQ(tree.nearest(p, guess, least).simplex, kNoSimplex);
        EXPECT_EQ(tree.nearest(p, guess, 0.5 * least).squared, 0.5 * least);
    }
    const Label label = sorted.strata[found.stratum].labels[0];
    EXPECT_EQ(tree.nearest_of_label(p, label, 1.001 * least).squared, least);
    EXPECT_EQ(tree.nearest_of_label(p, label, least).simplex, kNoSimplex);
    EXPECT_EQ(tree.nearest_of_stratum(p, found.stratum, 1.001 * least).squared, least);
    EXPECT_EQ(tree.nearest_of_stratum(p, found.stratum, least).simplex, kNoSimplex);
}

TEST(StrataTree, finds_nothing_where_there_is_nothing) {
    const LabelTable table = labels_up_to(6);
    const CommonLabels labels(table, table);
    const Mesh none;
    const SortedStrata nothing = interfaces_of({none, labels, 0, {}}, 1);
    const StrataTree empty(nothing, 1);
    EXPECT_EQ(empty.nearest({1, 2, 3}).simplex, kNoSimplex);
    EXPECT_EQ(empty.nearest_of_label({1, 2, 3}, 0).simplex, kNoSimplex);
    EXPECT_EQ(empty.nearest_of_stratum({1, 2, 3}, 0).simplex, kNoSimplex);
    const Mesh some = scattered_faces(1, 1);
    const SortedStrata one = interfaces_of({some, labels, 0, {}}, 1);
    const StrataTree tree(one, 1);
    EXPECT_EQ(tree.nearest_of_stratum({1, 2, 3}, kNoStratum).simplex, kNoSimplex);
    EXPECT_EQ(tree.nearest_of_label({1, 2, 3}, 77).simplex, kNoSimplex);
}

TEST(SortedStrata, hold_every_face_once_under_its_labels) {
    const Mesh mesh = scattered_faces(500, 5);
    const LabelTable other = test::labels_from({5, 3, 9, 1, 0, 2, 4});
    const LabelTable table = labels_up_to(6);
    const CommonLabels labels(other, table);
    const SortedStrata sorted = interfaces_of({mesh, labels, 1, {}}, 2);
    const auto leftmost = [](const std::array<Vec3, 3>& p) { return std::min({p[0].x, p[1].x, p[2].x}); };
    std::multiset<std::pair<std::vector<Label>, double>> found, expected;
    std::uint32_t end = 0;
    for (const Stratum& stratum : sorted.strata) {
        EXPECT_EQ(stratum.begin, end);
        end = stratum.end;
        for (std::uint32_t n = stratum.begin; n < stratum.end; ++n) {
            const auto& [a, b, c] = sorted.simplices[n];
            found.insert({stratum.labels, leftmost({sorted.points[a], sorted.points[b], sorted.points[c]})});
        }
    }
    for (std::uint32_t f = 0; f < mesh.face_end(); ++f)
        expected.insert({{mesh[FaceId{f}].labels[0], mesh[FaceId{f}].labels[1]}, leftmost(mesh.corners(FaceId{f}))});
    EXPECT_EQ(found, expected);
}

}  // namespace
}  // namespace regionmesh
