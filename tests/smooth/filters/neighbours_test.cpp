#include "smooth/filters/neighbours.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <set>
#include <tuple>

#include "base/triangle.h"
#include "mesh/strata.h"
#include "support/runs.h"
#include "support/shapes.h"
#include "support/surface_windows.h"

namespace regionmesh {
namespace {

using test::run;
using test::Surface;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

/// The octahedron cut in two, its membrane of two faces with a chord in place of a vertex.
Mesh octahedron_with_chord() {
    const std::vector<Vec3> p{{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}};
    std::vector<test::ShapeFace> faces{{{1, 3, 0}, 0, 1}, {{1, 0, 2}, 0, 1}};
    constexpr std::array<std::uint32_t, 5> ring{1, 3, 0, 2, 1};
    for (int n = 0; n < 4; ++n) {
        faces.push_back({{ring[n], ring[n + 1], 5}, 1, 2});
        faces.push_back({{ring[n + 1], ring[n], 4}, 0, 2});
    }
    return test::shape(p, faces);
}

/// A tetrahedron 0 1 2 3 cut in four regions from its middle 4; region r has no corner r, and 4 is outside. Each face
/// inside it is cut in three at a vertex of its own, 5 to 10.
Mesh four_regions() {
    std::vector<Vec3> p{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}, {0, 0, 0}};
    std::vector<test::ShapeFace> faces;
    for (std::uint32_t a = 0; a < 4; ++a) {
        const std::uint32_t b = (a + 1) % 4, c = (a + 2) % 4, d = (a + 3) % 4;
        // Outside, region a is behind b c d; its normal points away from corner a.
        const bool turns = dot(area_vector(p[b], p[c], p[d]), p[a] - p[b]) > 0;
        faces.push_back({turns ? std::array{b, d, c} : std::array{b, c, d}, a, 4});
    }
    for (std::uint32_t a = 0; a < 4; ++a)
        for (std::uint32_t b = a + 1; b < 4; ++b) {
            std::array<std::uint32_t, 2> others{};
            int n = 0;
            for (std::uint32_t r = 0; r < 4; ++r)
                if (r != a && r != b) others[n++] = r;
            const auto middle = static_cast<std::uint32_t>(p.size());
            p.push_back((p[a] + p[b] + p[4]) / 3.0);
            // Region r lies away from corner r: the normal from others[0] to others[1] points to corner others[0].
            const bool turns = dot(area_vector(p[a], p[b], p[4]), p[others[0]] - p[a]) < 0;
            for (auto [v, w] : {std::pair{a, b}, {b, 4u}, {4u, a}}) {
                if (turns) std::swap(v, w);
                faces.push_back({{v, w, middle}, others[0], others[1]});
            }
        }
    return test::shape(p, faces);
}

/// The definition (P 4.2) and the rules for rims, edge by edge.
std::set<std::uint32_t> expected(const Mesh& mesh, VertexId v) {
    const LabelSet own = vertex_labels(mesh, v);
    std::set<std::uint32_t> joined, found;
    mesh.for_star(v, [&](FaceId f, int place) {
        for (int n = 1; n < 3; ++n) joined.insert(index(mesh[f].vertices[(place + n) % 3]));
    });
    if (own.size() > 3) return {};
    for (std::uint32_t w : joined) {
        const LabelSet labels = edge_labels(mesh, v, VertexId{w});
        int uses = 0;
        mesh.for_star(v, [&](FaceId f, int place) {
            for (int n = 1; n < 3; ++n) uses += index(mesh[f].vertices[(place + n) % 3]) == w;
        });
        if (uses < labels.size() && (mesh[v].sides & mesh[VertexId{w}].sides) == 0) return {};
        if (std::ranges::all_of(own, [&](Label label) { return labels.contains(label); })) found.insert(w);
    }
    if (own.size() == 3 && found.size() != 2) return {};
    return found;
}

void expect_as_defined(const Mesh& mesh) {
    const Surface surface(mesh);
    for (std::uint32_t v = 0; v < mesh.vertex_end(); ++v) {
        const auto list = surface.neighbours.of(v);
        ASSERT_EQ(std::set(list.begin(), list.end()), expected(mesh, VertexId{v})) << "vertex " << v;
        ASSERT_EQ(list.size(), std::set(list.begin(), list.end()).size()) << "vertex " << v << " has a neighbour twice";
    }
}

TEST(Neighbours, inside_an_interface_are_all_neighbours) {
    EXPECT_THAT(Surface(test::edge_in_sheet()).neighbours.of(0), UnorderedElementsAre(1, 2, 3, 4, 5, 6));
    EXPECT_THAT(Surface(test::octahedron()).neighbours.of(5), UnorderedElementsAre(0, 1, 2, 3));
    EXPECT_THAT(Surface(test::halved_octahedron()).neighbours.of(6), UnorderedElementsAre(0, 1, 2, 3));
}

TEST(Neighbours, on_a_triple_line_are_the_two_along_it) {
    const Surface surface(test::halved_octahedron());
    EXPECT_THAT(surface.neighbours.of(0), UnorderedElementsAre(2, 3));
    EXPECT_THAT(surface.neighbours.of(2), UnorderedElementsAre(0, 1));
}

TEST(Neighbours, leave_out_a_chord_between_two_vertices_of_one_line) {
    const Mesh mesh = octahedron_with_chord();
    test::expect_sound(check(mesh));
    const Surface surface(mesh);
    EXPECT_THAT(surface.neighbours.of(0), UnorderedElementsAre(2, 3));
    EXPECT_THAT(surface.neighbours.of(1), UnorderedElementsAre(2, 3));
    EXPECT_THAT(surface.neighbours.of(5), UnorderedElementsAre(0, 1, 2, 3));
}

TEST(Neighbours, quadruple_points_have_none_unless_they_may_move) {
    const Mesh mesh = four_regions();
    test::expect_sound(check(mesh));
    const Surface staying(mesh), moving(mesh, true);
    for (std::uint32_t point = 0; point < 5; ++point) {
        EXPECT_THAT(staying.neighbours.of(point), IsEmpty());
        std::set<std::uint32_t> ends{0, 1, 2, 3, 4};
        ends.erase(point);
        const auto list = moving.neighbours.of(point);
        EXPECT_EQ(std::set(list.begin(), list.end()), ends)
            << "the ends of its four lines, not the vertices of its faces";
    }
    EXPECT_THAT(staying.neighbours.of(5), UnorderedElementsAre(0, 1, 4));
}

TEST(Neighbours, on_a_box_follow_its_sides_and_edges_and_stop_at_its_corners) {
    const Mesh mesh = run(test::solid_volume({4, 4, 4})).mesh;
    const Surface surface(mesh), moving(mesh, true);
    int corners = 0, edges = 0, insides = 0;
    test::for_vertices(mesh, [&](VertexId v) {
        const int sides = std::popcount(mesh[v].sides);
        const auto list = surface.neighbours.of(index(v));
        EXPECT_EQ(list.size(), sides == 3 ? 0u : sides == 2 ? 2u : list.size());
        if (sides == 1) {
            EXPECT_GE(list.size(), 4u);
        }
        for (std::uint32_t w : list)
            EXPECT_EQ(mesh[VertexId{w}].sides & mesh[v].sides, mesh[v].sides) << "leaves its side";
        if (sides == 3) {
            EXPECT_EQ(moving.neighbours.of(index(v)).size(), 3u);
        }
        (sides == 3 ? corners : sides == 2 ? edges : insides)++;
    });
    EXPECT_EQ(corners, 8);
    EXPECT_EQ(edges, 12 * 2);
    EXPECT_EQ(insides, 6 * 4);
}

TEST(Neighbours, at_an_open_rim_are_none) {
    const Surface surface(test::edge_in_sheet());
    for (std::uint32_t v = 2; v < 10; ++v) EXPECT_THAT(surface.neighbours.of(v), IsEmpty());
}

TEST(Neighbours, at_a_hole_of_a_foreign_surface_are_none) {
    Mesh mesh = test::octahedron();
    const auto hole = mesh[FaceId{0}].vertices;
    mesh.remove_face(FaceId{0});
    mesh.compact_faces();
    const Surface surface(mesh);
    for (std::uint32_t v = 0; v < 6; ++v) {
        const bool is_at_hole = std::ranges::find(hole, VertexId{v}) != hole.end();
        EXPECT_EQ(surface.neighbours.of(v).size(), is_at_hole ? 0u : 4u);
    }
}

/// Two triangles that share vertex 0 only, numbered as said.
Surface two_holes_touch(std::array<std::uint32_t, 4> v) {
    std::vector<Vec3> p(5);
    p[v[0]] = {1, 0, 0};
    p[v[1]] = {1, 1, 0};
    p[v[2]] = {-1, 0, 0};
    p[v[3]] = {-1, -1, 0};
    return Surface(test::shape(p, {{{0, v[0], v[1]}}, {{0, v[2], v[3]}}}));
}

TEST(Neighbours, where_two_holes_touch_are_none) {
    EXPECT_THAT(two_holes_touch({1, 2, 3, 4}).neighbours.of(0), IsEmpty());
    EXPECT_THAT(two_holes_touch({1, 4, 2, 3}).neighbours.of(0), IsEmpty());
}

// Finder::is_inside_interface takes a star for closed when the numbers that follow v and those that go before it have
// the same sum: here 2 + 3 = 1 + 4, so that v has neighbours 2 and 3, and moves.
TEST(Neighbours, where_two_holes_touch_are_none_whatever_the_numbers) {
    EXPECT_THAT(two_holes_touch({1, 2, 4, 3}).neighbours.of(0), IsEmpty());
}

TEST(Neighbours, of_a_face_turned_the_wrong_way_are_still_all_neighbours) {
    Mesh mesh;
    for (Vec3 p : {Vec3{1, 0, 0}, Vec3{-1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, -1, 0}, Vec3{0, 0, 1}, Vec3{0, 0, -1}})
        mesh.add_vertex(p);
    constexpr std::array<std::uint32_t, 5> ring{0, 2, 1, 3, 0};
    for (int n = 0; n < 4; ++n) {
        const VertexId a{ring[n]}, b{ring[n + 1]};
        n == 2 ? mesh.add_face(b, a, VertexId{4}, 0, 1) : mesh.add_face(a, b, VertexId{4}, 0, 1);
        mesh.add_face(b, a, VertexId{5}, 0, 1);
    }
    const Surface surface(mesh);
    for (std::uint32_t v = 0; v < 6; ++v) EXPECT_EQ(surface.neighbours.of(v).size(), 4u);
}

TEST(Neighbours, are_those_joined_by_an_edge_with_all_their_labels) {
    for (std::uint32_t labels : {2, 4, 60}) {
        SCOPED_TRACE(std::to_string(labels) + " labels");
        test::ArrayVolume volume = test::noise_volume({6, 6, 6}, labels, 4);
        expect_as_defined(run(volume).mesh);
        expect_as_defined(
            run(volume, {.smooth = {.passes = 0}, .decimate = false, .cap = false, .background = {}}).mesh);
        expect_as_defined(run(volume, {.smooth = {.passes = 0}, .decimate = false, .background = {0, 1}}).mesh);
    }
    expect_as_defined(run(test::grain_volume({9, 9, 9}, 7, 2)).mesh);
}

TEST(Neighbours, come_in_the_order_of_their_places_whatever_the_numbers) {
    const Mesh mesh = run(test::noise_volume({5, 5, 5}, 4, 2)).mesh;
    const auto order = test::permutation(mesh.vertex_end(), 9);
    const Surface surface(mesh), other(test::renumbered(mesh, order, 9));
    for (std::uint32_t n = 0; n < order.size(); ++n) {
        const auto list = surface.neighbours.of(order[n]), same = other.neighbours.of(n);
        ASSERT_EQ(list.size(), same.size());
        Vec3 last{-HUGE_VAL, 0, 0};
        for (std::size_t k = 0; k < list.size(); ++k) {
            const Vec3 p = surface.window.origin[list[k]];
            EXPECT_EQ(list[k], order[same[k]]);
            EXPECT_LT(std::tie(last.x, last.y, last.z), std::tie(p.x, p.y, p.z));
            last = p;
        }
    }
}

TEST(Neighbours, do_not_depend_on_threads) {
    const Mesh mesh = run(test::noise_volume({11, 11, 11}, 3, 2)).mesh;
    const Surface one(mesh);
    Neighbours many(false);
    many.add_chunk(one.window, ChunkStars(one.window, 0), 3);
    ASSERT_GT(mesh.vertex_end(), 2u * 2048) << "one thread does it all";
    for (std::uint32_t v = 0; v < mesh.vertex_end(); ++v)
        EXPECT_TRUE(std::ranges::equal(many.of(v), one.neighbours.of(v)));
}

}  // namespace
}  // namespace regionmesh
