#include "mesh/face_meeting.h"

#include <gtest/gtest.h>

#include "base/exact_predicates.h"
#include "support/random.h"

namespace regionmesh {
namespace {

using Corners = std::array<Vec3, 3>;

bool do_meet(const Corners& p, const Corners& q) {
    const Triangle s{p[0], p[1], p[2]}, t{q[0], q[1], q[2]};
    return !is_degenerate(s) && !is_degenerate(t) && meet(s, t);
}

TEST(AreApart, is_never_said_of_triangles_that_meet) {
    int apart = 0, meeting = 0;
    for (std::uint64_t seed = 0; seed < 30000; ++seed) {
        test::Random random(seed);
        Corners p, q;
        const int lattice = static_cast<int>(random.below(3));
        for (int n = 0; n < 3; ++n) {
            p[n] = lattice ? random.lattice_point(lattice) : random.point(1);
            q[n] = lattice ? random.lattice_point(lattice) : random.point(1);
        }
        if (random.below(3) == 0) q[0] = p[0] + random.unit() * (p[1] - p[0]);  // near an edge
        if (random.below(3) == 0) {
            const Vec3 away = 1e6 * random.point(1);
            for (int n = 0; n < 3; ++n) p[n] += away, q[n] += away;
        }
        const bool meets = do_meet(p, q);
        meets ? ++meeting : apart += are_apart(p, q);
        ASSERT_FALSE(meets && are_apart(p, q)) << "seed " << seed;
        ASSERT_FALSE(meets && are_apart(q, p)) << "seed " << seed;
    }
    EXPECT_GT(meeting, 3000);
    EXPECT_GT(apart, 3000);
}

TEST(AreApart, is_said_of_triangles_side_by_side_in_one_plane) {
    const Corners p{Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}}, q{Vec3{1, 1, 0}, Vec3{1, 0.1, 0}, Vec3{0.1, 1, 0}};
    EXPECT_TRUE(are_apart(p, q)) << "though their boxes overlap";
}

TEST(ShareVertex, is_by_number) {
    const auto three = [](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        return std::array{VertexId{a}, VertexId{b}, VertexId{c}};
    };
    EXPECT_TRUE(share_vertex(three(1, 2, 3), three(4, 5, 1)));
    EXPECT_TRUE(share_vertex(three(1, 2, 3), three(3, 2, 1)));
    EXPECT_FALSE(share_vertex(three(1, 2, 3), three(4, 5, 6)));
}

}  // namespace
}  // namespace regionmesh
