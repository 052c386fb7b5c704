#include "surface/bodies.h"

#include <gtest/gtest.h>

#include "support/runs.h"
#include "support/shapes.h"

namespace regionmesh {
namespace {

using test::add_octahedron;

std::vector<const Body*> bodies_of(const Bodies& bodies, Label label) {
    std::vector<const Body*> found;
    for (const Body& body : bodies.all())
        if (body.label == label) found.push_back(&body);
    return found;
}

double volume(double radius) { return 4.0 / 3 * radius * radius * radius; }

/// The distance beyond the plane of the octahedron's faces; negative inside.
double outside_of(Vec3 p, Vec3 middle, double radius) {
    return std::abs(p.x - middle.x) + std::abs(p.y - middle.y) + std::abs(p.z - middle.z) - radius;
}

TEST(Bodies, solid_in_another_label_is_one_body_and_its_surroundings_are_unbounded) {
    const Mesh mesh = test::octahedron();
    const Bodies bodies(mesh);
    ASSERT_EQ(bodies.all().size(), 2u);
    EXPECT_EQ(bodies.shell_count(), 2u);
    const Body& inside = *bodies_of(bodies, 0)[0];
    EXPECT_TRUE(inside.is_bounded);
    EXPECT_NEAR(inside.volume, volume(1), 1e-12);
    EXPECT_FALSE(bodies_of(bodies, 1)[0]->is_bounded);
    const auto point = bodies.point_inside(inside);
    ASSERT_TRUE(point);
    EXPECT_LT(outside_of(*point, {}, 1), -0.1);
}

TEST(Bodies, regions_on_both_sides_of_a_membrane_have_a_shell_each) {
    const Mesh mesh = test::halved_octahedron();
    const Bodies bodies(mesh);
    EXPECT_EQ(bodies.all().size(), 3u);
    for (Label label = 0; label < 2; ++label) {
        ASSERT_EQ(bodies_of(bodies, label).size(), 1u);
        EXPECT_NEAR(bodies_of(bodies, label)[0]->volume, volume(1) / 2, 1e-12);
        const auto point = bodies.point_inside(*bodies_of(bodies, label)[0]);
        ASSERT_TRUE(point);
        EXPECT_EQ(point->z > 0, label == 1);
    }
}

/// Onions: label 0 and 1 in turn, from the outside 5, 4, 3, 2; and beside them a body of label 0 of its own.
class Onion : public testing::Test {
protected:
    Onion() {
        add_octahedron(mesh_, {}, {5, 5, 5}, 0, 2);
        add_octahedron(mesh_, {}, {4, 4, 4}, 1, 0);
        add_octahedron(mesh_, {}, {3, 3, 3}, 0, 1);
        add_octahedron(mesh_, {}, {2, 2, 2}, 1, 0);
        add_octahedron(mesh_, {9, 0, 0}, {1, 1, 1}, 0, 2);
    }
    Mesh mesh_;
};

TEST_F(Onion, cavity_belongs_to_the_innermost_body_round_it) {
    const Bodies bodies(mesh_);
    const auto zero = bodies_of(bodies, 0), one = bodies_of(bodies, 1);
    ASSERT_EQ(zero.size(), 3u);
    ASSERT_EQ(one.size(), 2u);
    EXPECT_EQ(zero[0]->shells.size(), 2u);
    EXPECT_NEAR(zero[0]->volume, volume(5) - volume(4), 1e-9);
    EXPECT_EQ(zero[1]->shells.size(), 2u);
    EXPECT_NEAR(zero[1]->volume, volume(3) - volume(2), 1e-9);
    EXPECT_EQ(zero[2]->shells.size(), 1u);
    EXPECT_NEAR(one[0]->volume, volume(4) - volume(3), 1e-9);
    EXPECT_NEAR(one[1]->volume, volume(2), 1e-9);
}

TEST_F(Onion, point_lies_between_the_outer_shell_and_the_cavity) {
    const Bodies bodies(mesh_);
    for (const Body* body : bodies_of(bodies, 0)) {
        const auto point = bodies.point_inside(*body);
        ASSERT_TRUE(point);
        if (outside_of(*point, {9, 0, 0}, 1) < 0) continue;
        const double radius = outside_of(*point, {}, 0);
        EXPECT_TRUE((radius > 2 && radius < 3) || (radius > 4 && radius < 5)) << radius;
    }
}

TEST_F(Onion, outside_of_two_bodies_is_unbounded) {
    const Bodies bodies(mesh_);
    const auto outside = bodies_of(bodies, 2);
    ASSERT_EQ(outside.size(), 2u);  // a shell each: nothing is round both
    for (const Body* body : outside) EXPECT_FALSE(body->is_bounded);
}

TEST(Bodies, far_from_the_origin_small_bodies_keep_their_sides) {
    Mesh mesh;
    const Vec3 middle{1e6, -2e6, 3e6};
    add_octahedron(mesh, middle, {1e-3, 1e-3, 1e-3});
    const Bodies bodies(mesh);
    ASSERT_TRUE(bodies_of(bodies, 0)[0]->is_bounded);
    const auto point = bodies.point_inside(*bodies_of(bodies, 0)[0]);
    ASSERT_TRUE(point);
    EXPECT_LT(outside_of(*point, middle, 1e-3), 0);
}

TEST(Bodies, six_sides_of_the_box_are_one_exterior_round_all) {
    const auto made = test::run(test::grain_volume({8, 8, 8}, 5, 1));
    const Bodies bodies(made.mesh);
    const auto outside = bodies_of(bodies, exterior(0));
    ASSERT_EQ(outside.size(), 1u);
    EXPECT_FALSE(outside[0]->is_bounded);
    EXPECT_EQ(outside[0]->shells.size(), 1u);
}

TEST(Bodies, every_part_of_noise_has_a_point_inside_and_all_volumes_fill_the_box) {
    for (const std::uint64_t seed : {1, 2, 3}) {
        SCOPED_TRACE(seed);
        auto options = test::reduced(0.5);
        options.smooth.passes = 5;
        const auto made = test::run(test::noise_volume({9, 9, 9}, 4, seed), options);
        const Bodies bodies(made.mesh);
        double sum = 0;
        std::size_t bounded = 0;
        for (const Body& body : bodies.all()) {
            if (!body.is_bounded) continue;
            ++bounded;
            sum += body.volume;
            EXPECT_TRUE(bodies.point_inside(body));
        }
        EXPECT_GT(bounded, 10u);
        EXPECT_NEAR(sum, 8 * 8 * 8, 1e-9);
    }
}

TEST(Bodies, two_bodies_of_a_label_that_share_an_edge_are_two) {
    // Wedges round the z axis, in the first and the third quarter, closed to tetrahedra.
    Mesh mesh = test::shape({{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}}, {});
    const auto tetrahedron = [&](std::array<std::uint32_t, 4> v) {
        for (const auto& [a, b, c] :
             {std::array{0, 2, 1}, std::array{0, 1, 3}, std::array{0, 3, 2}, std::array{1, 2, 3}})
            mesh.add_face(VertexId{v[a]}, VertexId{v[b]}, VertexId{v[c]}, 0, 1);
    };
    tetrahedron({0, 2, 3, 1});
    tetrahedron({0, 4, 5, 1});
    const Bodies bodies(mesh);
    const auto inside = bodies_of(bodies, 0);
    ASSERT_EQ(inside.size(), 2u);
    for (const Body* body : inside) EXPECT_NEAR(body->volume, 1.0 / 6, 1e-15);
}

}  // namespace
}  // namespace regionmesh
