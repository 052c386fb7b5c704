#include "mesh/face_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "base/hash.h"
#include "mesh/extent.h"
#include "support/runs.h"

namespace regionmesh {
namespace {

using Faces = std::set<std::uint32_t>;

bool do_meet(const Box& a, const Box& b) {
    for (int axis = 0; axis < 3; ++axis)
        if (a.low[axis] > b.high[axis] || a.high[axis] < b.low[axis]) return false;
    return true;
}

Faces found_in(const FaceTree& tree, const Box& box) {
    Faces faces;
    tree.search(box, [&](std::span<const std::uint32_t> some) {
        for (const std::uint32_t f : some) EXPECT_TRUE(faces.insert(f).second) << "visited twice";
        return true;
    });
    return faces;
}

/// All faces that meet the box must be visited; more may be, within the rounding.
void expect_all_found(const Mesh& mesh, const FaceTree& tree, const Box& box) {
    const Faces found = found_in(tree, box);
    constexpr double kRounding = 1e-3;
    const Vec3 margin{kRounding, kRounding, kRounding};
    const Box wide{box.low - margin, box.high + margin};
    for (std::uint32_t n = 0; n < mesh.face_end(); ++n) {
        const FaceId f{n};
        const bool must = mesh.is_alive(f) && do_meet(box_of(mesh, f), box);
        const bool may = mesh.is_alive(f) && do_meet(box_of(mesh, f), wide);
        EXPECT_TRUE(found.contains(n) ? may : !must) << "face " << n << (must ? " was missed" : " is far");
    }
}

class Random {
public:
    explicit Random(std::uint64_t seed) : state_(seed) {}
    std::uint32_t below(std::uint32_t end) { return static_cast<std::uint32_t>((state_ = mix64(state_)) % end); }
    double unit() { return below(1u << 30) * 0x1p-30; }
    Box box(double extent, double size) {
        const Vec3 low{unit() * extent, unit() * extent, unit() * extent};
        return {low, low + size * Vec3{unit(), unit(), unit()}};
    }

private:
    std::uint64_t state_;
};

Mesh sorted_noise() {
    Mesh mesh = test::run(test::noise_volume({9, 9, 9}, 4, 3)).mesh;
    mesh.sort_spatially();
    return mesh;
}

class FaceTreeOf : public testing::TestWithParam<FaceTree::Faces> {};

TEST_P(FaceTreeOf, finds_all_faces_that_meet_a_box) {
    const Mesh mesh = sorted_noise();
    const FaceTree tree(mesh, 2, GetParam());
    Random random(1);
    for (int n = 0; n < 200; ++n) expect_all_found(mesh, tree, random.box(9, n % 10 ? 1.5 : 0));
}

TEST_P(FaceTreeOf, finds_faces_that_only_touch) {
    const Mesh mesh = sorted_noise();
    const FaceTree tree(mesh, 1, GetParam());
    test::for_faces(mesh, [&](FaceId f) {
        const Box own = box_of(mesh, f);
        EXPECT_TRUE(found_in(tree, {own.high, own.high}).contains(index(f)));
        EXPECT_TRUE(found_in(tree, {own.low, own.low}).contains(index(f)));
    });
}

TEST_P(FaceTreeOf, follows_faces_that_move_and_go) {
    Mesh mesh = sorted_noise();
    FaceTree tree(mesh, 1, GetParam());
    Random random(2);
    for (int n = 0; n < 500; ++n) {
        const VertexId v{random.below(mesh.vertex_end())};
        mesh[v].position += 0.3 * random.unit() * (Vec3{4, 4, 4} - mesh[v].position);
        mesh.for_star(v, [&](FaceId f, int) { tree.set(f, box_of(mesh, f)); });
        const FaceId gone{random.below(mesh.face_end())};
        if (!mesh.is_alive(gone)) continue;
        mesh.remove_face(gone);
        tree.remove(gone);
    }
    for (int n = 0; n < 200; ++n) expect_all_found(mesh, tree, random.box(9, 2));
    tree.build();
    for (int n = 0; n < 200; ++n) expect_all_found(mesh, tree, random.box(9, 2));
}

TEST_P(FaceTreeOf, finds_faces_that_left_the_box_it_was_built_for) {
    Mesh mesh = test::run(test::solid_volume({3, 3, 3})).mesh;
    FaceTree tree(mesh, 1, GetParam());
    const FaceId f{5};
    for (VertexId v : mesh[f].vertices) mesh[v].position += Vec3{100, -100, 1e9};
    tree.set(f, box_of(mesh, f));
    EXPECT_TRUE(found_in(tree, box_of(mesh, f)).contains(5));
}

TEST_P(FaceTreeOf, search_ends_when_told) {
    const Mesh mesh = sorted_noise();
    int visited = 0;
    const auto visit = [&](std::span<const std::uint32_t> some) {
        EXPECT_LE(some.size(), FaceTree::kMostAtOnce);
        return ++visited < 3;
    };
    FaceTree(mesh, 1, GetParam()).search({{0, 0, 0}, {9, 9, 9}}, visit);
    EXPECT_EQ(visited, 3);
}

TEST_P(FaceTreeOf, an_empty_model_finds_nothing) {
    const Mesh mesh;
    EXPECT_TRUE(found_in(FaceTree(mesh, 1, GetParam()), {{0, 0, 0}, {1, 1, 1}}).empty());
}

TEST_P(FaceTreeOf, finds_nothing_but_faces_in_a_box_round_the_whole_model) {
    for (std::uint32_t faces : {1, 7, 8, 9, 64, 65}) {
        Mesh mesh;
        for (std::uint32_t n = 0; n < faces; ++n) {
            const double x = n;
            const VertexId a = mesh.add_vertex({x, 0, 0}), b = mesh.add_vertex({x, 1, 0}),
                           c = mesh.add_vertex({x, 0, 1});
            mesh.add_face(a, b, c, 0, 1);
        }
        FaceTree tree(mesh, 1, GetParam());
        EXPECT_EQ(found_in(tree, {{-1, -1, -1}, {100, 2, 2}}).size(), faces);
        mesh.remove_face(FaceId{0});
        tree.remove(FaceId{0});
        EXPECT_EQ(found_in(tree, {{-1, -1, -1}, {100, 2, 2}}).size(), faces - 1);
    }
}

TEST(FaceTree, takes_half_the_bytes_in_pairs) {
    const Mesh mesh = sorted_noise();
    EXPECT_LE(FaceTree(mesh, 1, FaceTree::Faces::kInPairs).bytes(), FaceTree(mesh).bytes() * 51 / 100);
}

INSTANTIATE_TEST_SUITE_P(faces, FaceTreeOf, testing::Values(FaceTree::Faces::kOneByOne, FaceTree::Faces::kInPairs),
                         [](const auto& faces) {
                             return faces.param == FaceTree::Faces::kInPairs ? "in_pairs" : "one_by_one";
                         });

}  // namespace
}  // namespace regionmesh
