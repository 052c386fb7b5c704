#include "smooth/islands.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/hash.h"
#include "support/shapes.h"

namespace regionmesh {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// The triangle (0,0) (4,0) (0,4) at height z.
std::array<Vec3, 3> at_height(double z) { return {Vec3{0, 0, z}, Vec3{4, 0, z}, Vec3{0, 4, z}}; }

MovedFace moved(double from, double to) { return {{7, 3, 5}, at_height(from), at_height(to)}; }

TEST(MayChangeSides, a_point_that_passes_through_a_face_that_stays) {
    EXPECT_TRUE(may_change_sides({1, 1, -1}, {1, 1, 1}, moved(0, 0)));
    EXPECT_FALSE(may_change_sides({3, 3, -1}, {3, 3, 1}, moved(0, 0))) << "passes beside it";
    EXPECT_FALSE(may_change_sides({1, 1, -2}, {1, 1, -1}, moved(0, 0))) << "does not come so far";
}

TEST(MayChangeSides, a_face_that_sweeps_over_a_point_that_stays) {
    EXPECT_TRUE(may_change_sides({1, 1, 1}, {1, 1, 1}, moved(0, 2)));
    EXPECT_TRUE(may_change_sides({1, 1, 1}, {1, 1, 1}, moved(2, 0)));
    EXPECT_FALSE(may_change_sides({3, 3, 1}, {3, 3, 1}, moved(0, 2))) << "passes beside it";
    EXPECT_FALSE(may_change_sides({1, 1, 3}, {1, 1, 3}, moved(0, 2))) << "does not come so far";
    EXPECT_FALSE(may_change_sides({1, 1, -1}, {1, 1, -1}, moved(0, 2))) << "goes away";
}

TEST(MayChangeSides, not_when_both_go_together) {
    EXPECT_FALSE(may_change_sides({1, 1, 1}, {1, 1, 4}, moved(0, 3)));
    EXPECT_FALSE(may_change_sides({1, 1, 1}, {1, 1, 4}, moved(0, 0.5)));
    EXPECT_FALSE(may_change_sides({1, 1, 4}, {1, 1, 1}, moved(-1, 0)));
}

TEST(MayChangeSides, touching_is_taken_for_meeting) {
    EXPECT_TRUE(may_change_sides({1, 1, -1}, {1, 1, 0}, moved(0, 0)));
    EXPECT_TRUE(may_change_sides({1, 1, 1}, {1, 1, 1}, moved(0, 1)));
    EXPECT_TRUE(may_change_sides({0, 2, -1}, {0, 2, 1}, moved(0, 0))) << "through an edge";
    EXPECT_TRUE(may_change_sides({0, 0, -1}, {0, 0, 1}, moved(0, 0))) << "through a corner";
}

TEST(MayChangeSides, a_face_and_a_point_that_stay_never_do) {
    EXPECT_FALSE(may_change_sides({1, 1, 1}, {1, 1, 1}, moved(0, 0)));
    EXPECT_FALSE(may_change_sides({1, 1, 1e-300}, {1, 1, 1e-300}, moved(0, 0)));
}

TEST(MayChangeSides, faces_on_both_sides_of_an_edge_leave_no_gap_between_them) {
    // A square of two triangles turns while it rises, its diagonal too: what is swept is no prism.
    const std::array<Vec3, 4> before{Vec3{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    const std::array<Vec3, 4> after{Vec3{0, 0, 1}, {1, 0, 2}, {1, 1, 1}, {0, 1, 2}};
    for (std::uint32_t first : {0u, 10u}) {
        // The same square with the numbers of its vertices the other way round.
        const auto number = [&](std::uint32_t n) { return first == 0 ? n : first - n; };
        const auto face = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
            return MovedFace{
                {number(a), number(b), number(c)}, {before[a], before[b], before[c]}, {after[a], after[b], after[c]}};
        };
        const MovedFace one = face(0, 1, 2), other = face(2, 3, 0);
        for (std::uint64_t n = 0; n < 2000; ++n) {
            const Vec3 p{0.05 + 0.9 * hash_unit(n, 1), 0.05 + 0.9 * hash_unit(n, 2), 0.05 + 0.9 * hash_unit(n, 3)};
            ASSERT_TRUE(may_change_sides(p, p, one) || may_change_sides(p, p, other))
                << p.x << " " << p.y << " " << p.z;
        }
    }
}

/// How often a closed surface goes round a point: the sum of the solid angles of its faces.
int windings(const std::vector<std::array<Vec3, 3>>& faces, Vec3 p) {
    double sum = 0;
    for (const auto& t : faces) {
        const Vec3 a = t[0] - p, b = t[1] - p, c = t[2] - p;
        const double la = length(a), lb = length(b), lc = length(c);
        sum += 2 * std::atan2(dot(a, cross(b, c)), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
    }
    return static_cast<int>(std::lround(sum / (4 * std::acos(-1.0))));
}

TEST(MayChangeSides, what_no_face_may_have_changed_is_where_it_was) {
    const Mesh mesh = test::octahedron();
    int stayed = 0, changed = 0;
    for (std::uint32_t n = 0; n < 3000; ++n) {
        const auto random = [&](std::uint32_t k) { return 2 * hash_unit(100 * n + k, k) - 1; };
        std::array<Vec3, 6> now;
        for (std::uint32_t v = 0; v < 6; ++v)
            now[v] = mesh.position(VertexId{v}) + 0.7 * Vec3{random(3 * v + 1), random(3 * v + 2), random(3 * v + 3)};
        const Vec3 from{random(30), random(31), random(32)}, to = from + 0.6 * Vec3{random(33), random(34), random(35)};
        std::vector<std::array<Vec3, 3>> before, after;
        bool may = false;
        for (std::uint32_t f = 0; f < 8; ++f) {
            const auto& v = mesh[FaceId{f}].vertices;
            const MovedFace face{{index(v[0]), index(v[1]), index(v[2])},
                                 mesh.corners(FaceId{f}),
                                 {now[index(v[0])], now[index(v[1])], now[index(v[2])]}};
            before.push_back(face.before);
            after.push_back(face.after);
            may = may || may_change_sides(from, to, face);
        }
        const bool changes = windings(before, from) != windings(after, to);
        ASSERT_TRUE(may || !changes) << "case " << n;
        stayed += !may;
        changed += changes;
    }
    EXPECT_GT(stayed, 500);
    EXPECT_GT(changed, 300);
}

/// A chunk of `count` new vertices, all at the origin.
Chunk chunk_of(std::uint32_t carried, std::uint32_t count, const std::vector<std::array<std::uint32_t, 3>>& corners,
               std::vector<std::uint32_t> active) {
    Chunk chunk{.carried = carried, .vertices = {}, .faces = {}, .active = std::move(active)};
    chunk.vertices.resize(count);
    for (const auto& face : corners) chunk.faces.push_back({face, {0, 1}});
    return chunk;
}

TEST(Parts, end_in_the_last_chunk_that_they_reach) {
    SurfaceWindow window;
    Parts parts;
    // Parts 0 1 2 and 3 4 5; then 6 and 7 join the second one; then 8 and 9 have no faces, and 10 continues the second.
    window.add(chunk_of(0, 6, {{0, 1, 2}, {3, 4, 5}}, {4, 5}));
    parts.add_chunk(window, 0);
    window.add(chunk_of(2, 2, {{0, 2, 1}, {2, 3, 1}}, {2, 3}));
    parts.add_chunk(window, 1);
    EXPECT_THAT(parts.that_end_in(window, 0), ElementsAre(2));
    window.add(chunk_of(2, 3, {{1, 0, 4}}, {}));
    parts.add_chunk(window, 2);
    EXPECT_THAT(parts.that_end_in(window, 1), IsEmpty());
    EXPECT_THAT(parts.that_end_in(window, 2), ElementsAre(8, 9, 10)) << "vertices without faces are parts, too";
    EXPECT_EQ(parts.root(3), 10u);
    EXPECT_EQ(parts.root(0), 2u);
}

TEST(Parts, are_joined_by_a_face_that_comes_late) {
    SurfaceWindow window;
    Parts parts;
    window.add(chunk_of(0, 6, {{0, 1, 2}, {3, 4, 5}}, {1, 4}));
    parts.add_chunk(window, 0);
    EXPECT_THAT(parts.that_end_in(window, 0), ElementsAre(2, 5));
    window.add(chunk_of(2, 1, {{0, 1, 2}}, {}));
    parts.add_chunk(window, 1);
    EXPECT_THAT(parts.that_end_in(window, 0), IsEmpty());
    EXPECT_THAT(parts.that_end_in(window, 1), ElementsAre(6));
    for (std::uint32_t v = 0; v < 7; ++v) EXPECT_EQ(parts.root(v), 6u);
}

TEST(Parts, whose_first_vertices_were_released_are_still_one) {
    // A ribbon, one face a chunk.
    SurfaceWindow window;
    Parts parts;
    for (std::uint32_t n = 2; n < 500; ++n) {
        window.add(n == 2 ? chunk_of(0, 3, {{0, 1, 2}}, {1, 2}) : chunk_of(2, 1, {{0, 1, 2}}, {1, 2}));
        parts.add_chunk(window, n - 2);
        if (n < 4) continue;
        EXPECT_THAT(parts.that_end_in(window, n - 3), IsEmpty());
        parts.drop_before(n - 2);
    }
    EXPECT_THAT(parts.that_end_in(window, 497), ElementsAre(499));
    EXPECT_EQ(parts.root(498), 499u);
    EXPECT_LT(parts.bytes(), 100u);
}

}  // namespace
}  // namespace regionmesh
