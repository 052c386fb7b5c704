#include "regionmesh/model/face_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "regionmesh/base/hash.h"
#include "support/runs.h"

namespace regionmesh {
namespace {

using Faces = std::set<std::uint32_t>;

Box box_of(const Model& model, FaceId f) {
    Box box;
    for (Vec3 p : model.corners(f)) box.add(p);
    return box;
}

bool do_meet(const Box& a, const Box& b) {
    for (int axis = 0; axis < 3; ++axis)
        if (a.low[axis] > b.high[axis] || a.high[axis] < b.low[axis]) return false;
    return true;
}

Faces found_in(const FaceTree& tree, const Box& box) {
    Faces faces;
    tree.search(box, [&](FaceId f, const FaceTree::GridBox&) {
        EXPECT_TRUE(faces.insert(index(f)).second) << "visited twice";
        return true;
    });
    return faces;
}

/// All faces that meet the box must be visited; more may be, within the rounding.
void expect_all_found(const Model& model, const FaceTree& tree, const Box& box) {
    const Faces found = found_in(tree, box);
    constexpr double kRounding = 1e-3;
    const Vec3 margin{kRounding, kRounding, kRounding};
    const Box wide{box.low - margin, box.high + margin};
    for (std::uint32_t n = 0; n < model.face_end(); ++n) {
        const FaceId f{n};
        const bool must = model.is_alive(f) && do_meet(box_of(model, f), box);
        const bool may = model.is_alive(f) && do_meet(box_of(model, f), wide);
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

Model sorted_noise() {
    Model model = test::run(test::noise_volume({9, 9, 9}, 4, 3)).model;
    model.sort_spatially();
    return model;
}

TEST(FaceTree, finds_all_faces_that_meet_a_box) {
    const Model model = sorted_noise();
    const FaceTree tree(model);
    Random random(1);
    for (int n = 0; n < 200; ++n) expect_all_found(model, tree, random.box(9, n % 10 ? 1.5 : 0));
}

TEST(FaceTree, finds_faces_that_only_touch) {
    const Model model = sorted_noise();
    const FaceTree tree(model);
    test::for_faces(model, [&](FaceId f) {
        const Box own = box_of(model, f);
        EXPECT_TRUE(found_in(tree, {own.high, own.high}).contains(index(f)));
        EXPECT_TRUE(found_in(tree, {own.low, own.low}).contains(index(f)));
    });
}

TEST(FaceTree, follows_faces_that_move_and_go) {
    Model model = sorted_noise();
    FaceTree tree(model);
    Random random(2);
    for (int n = 0; n < 500; ++n) {
        const VertexId v{random.below(model.vertex_end())};
        model[v].position += 0.3 * random.unit() * (Vec3{4, 4, 4} - model[v].position);
        model.for_star(v, [&](FaceId f, int) { tree.set(f, box_of(model, f)); });
        const FaceId gone{random.below(model.face_end())};
        if (!model.is_alive(gone)) continue;
        model.remove_face(gone);
        tree.remove(gone);
    }
    for (int n = 0; n < 200; ++n) expect_all_found(model, tree, random.box(9, 2));
}

TEST(FaceTree, finds_faces_that_left_the_box_it_was_built_for) {
    Model model = test::run(test::solid_volume({3, 3, 3})).model;
    FaceTree tree(model);
    const FaceId f{5};
    for (VertexId v : model[f].vertices) model[v].position += Vec3{100, -100, 1e9};
    tree.set(f, box_of(model, f));
    EXPECT_TRUE(found_in(tree, box_of(model, f)).contains(5));
}

TEST(FaceTree, search_ends_when_told) {
    const Model model = sorted_noise();
    int visited = 0;
    FaceTree(model).search({{0, 0, 0}, {9, 9, 9}}, [&](FaceId, const FaceTree::GridBox&) { return ++visited < 3; });
    EXPECT_EQ(visited, 3);
}

TEST(FaceTree, of_an_empty_model_finds_nothing) {
    const Model model;
    EXPECT_TRUE(found_in(FaceTree(model), {{0, 0, 0}, {1, 1, 1}}).empty());
}

TEST(FaceTree, finds_nothing_but_faces_in_a_box_round_the_whole_model) {
    for (std::uint32_t faces : {1, 7, 8, 9, 64, 65}) {
        Model model;
        for (std::uint32_t n = 0; n < faces; ++n) {
            const double x = n;
            const VertexId a = model.add_vertex({x, 0, 0}), b = model.add_vertex({x, 1, 0}), c = model.add_vertex({x, 0, 1});
            model.add_face(a, b, c, 0, 1);
        }
        FaceTree tree(model);
        EXPECT_EQ(found_in(tree, {{-1, -1, -1}, {100, 2, 2}}).size(), faces);
        tree.remove(FaceId{0});
        EXPECT_EQ(found_in(tree, {{-1, -1, -1}, {100, 2, 2}}).size(), faces - 1);
    }
}

}  // namespace
}  // namespace regionmesh
