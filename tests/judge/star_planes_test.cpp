#include "judge/verdict/star_planes.h"

#include <gtest/gtest.h>

#include "base/exact_predicates.h"
#include "support/random.h"
#include "support/shapes.h"

namespace regionmesh {
namespace {

EdgeStar star_of(const Mesh& mesh, Vec3 position) {
    EdgeStar star;
    gather(mesh, VertexId{0}, VertexId{1}, star);
    set_normals(star, position);
    return star;
}

/// Side of a plane through p and q that is square to the normal of the face: +1 where `out` would point.
int side_of_wall(Vec3 p, Vec3 q, Vec3 normal, Vec3 x) {
    return orientation(p, p + length(q - p) / length(normal) * normal, q, x);
}

/// What is told must be true: held against exact signs, where those of the walls are sure in spite of rounding.
void expect_true(const EdgeStar& star, Vec3 position, Vec3 q, std::uint64_t& told) {
    StarPlanes planes;
    planes.prepare(star, position, 0, star.face_count());
    const Sides sides = planes.sides_of(q), far = planes.far_sides_of(q);
    for (int n = 0; n < star.face_count(); ++n) {
        const Vec3 a = star.at_a(n), b = star.at_b(n), normal = star.new_normal(n);
        const auto bit = [n](std::uint32_t bits) { return (bits >> n & 1) != 0; };
        const int own = orientation(position, a, b, q), link = -side_of_wall(a, b, normal, q),
                  to_a = -side_of_wall(position, a, normal, q), to_b = side_of_wall(position, b, normal, q);
        for (const auto& [claim, holds] : {std::pair{bit(sides.above), own > 0},
                                           {bit(sides.below), own < 0},
                                           {bit(far.above), own < 0},
                                           {bit(far.below), own > 0},
                                           {bit(sides.link), link > 0},
                                           {bit(far.link), link < 0},
                                           {bit(sides.a), to_a > 0},
                                           {bit(far.a), to_a < 0},
                                           {bit(sides.b), to_b > 0},
                                           {bit(far.b), to_b < 0}}) {
            if (claim) ++told;
            ASSERT_TRUE(!claim || holds) << "face " << n;
        }
    }
}

TEST(StarPlanes, tells_only_what_is_true) {
    test::Random random(7);
    std::uint64_t told = 0;
    constexpr int kPoints = 3000;
    for (int n = 0; n < kPoints; ++n) {
        const Vec3 position{0.5, 0, random.between(-1, 1)};
        const EdgeStar star = star_of(test::edge_in_sheet(), position);
        expect_true(star, position, n % 2 ? random.point(3) : 0.5 * random.lattice_point(4), told);
    }
    EXPECT_GT(told, kPoints * 8u * 2u) << "most of it is told";
}

TEST(StarPlanes, tells_nothing_of_what_lies_in_a_plane) {
    const Vec3 position{0.5, 0, 0};
    const EdgeStar star = star_of(test::edge_in_sheet(), position);
    StarPlanes planes;
    planes.prepare(star, position, 0, star.face_count());
    for (Vec3 q : {Vec3{0.5, 0, 0}, Vec3{7, 3, 0}, Vec3{-1e6, 1e3, 0}, Vec3{0.25, 0.125, 1e-9}}) {
        EXPECT_EQ(planes.sides_of(q).above, 0u);
        EXPECT_EQ(planes.sides_of(q).below, 0u);
    }
}

TEST(StarPlanes, holds_at_any_size_and_place) {
    test::Random random(9);
    for (double scale : {1e-30, 1e-9, 1e9, 1e30}) {
        Mesh mesh = test::edge_in_sheet();
        for (std::uint32_t v = 0; v < mesh.vertex_end(); ++v)
            mesh[VertexId{v}].position = scale * (mesh.position(VertexId{v}) + Vec3{100, 200, 300});
        const Vec3 position = scale * Vec3{100.5, 200, 300.4};
        const EdgeStar star = star_of(mesh, position);
        std::uint64_t told = 0;
        for (int n = 0; n < 200; ++n) expect_true(star, position, position + scale * random.point(2), told);
        EXPECT_GT(told, 200u) << scale;
    }
}

}  // namespace
}  // namespace regionmesh
