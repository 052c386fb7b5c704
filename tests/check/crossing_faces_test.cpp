#include "check/crossing_faces.h"

#include <gtest/gtest.h>

#include "support/crossings.h"
#include "support/random.h"
#include "support/runs.h"
#include "support/shapes.h"

namespace regionmesh {
namespace {

/// Faces on any three of some vertices, near each other or not; some repeat a vertex or another face.
Mesh random_soup(test::Random& random, std::uint32_t vertices, std::uint32_t faces, int lattice) {
    Mesh mesh;
    for (std::uint32_t n = 0; n < vertices; ++n)
        mesh.add_vertex(lattice ? random.lattice_point(lattice) : random.point(1));
    for (std::uint32_t n = 0; n < faces; ++n) {
        const std::uint32_t from = random.below(vertices), reach = random.below(4) ? vertices : 4;
        const auto some = [&] { return VertexId{(from + random.below(reach)) % vertices}; };
        mesh.add_face(some(), some(), some(), random.below(3), random.below(3));
    }
    return mesh;
}

TEST(FindCrossings, says_what_all_pairs_say_of_a_soup) {
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        SCOPED_TRACE(testing::Message() << "seed " << seed);
        test::Random random(seed);
        test::expect_all_crossings_found(
            random_soup(random, 3 + random.below(40), random.below(80), static_cast<int>(random.below(4))));
    }
}

TEST(FindCrossings, says_what_all_pairs_say_of_many_small_faces) {
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
        SCOPED_TRACE(testing::Message() << "seed " << seed);
        test::Random random(seed);
        Mesh mesh;
        for (std::uint32_t n = 0; n < 1500; ++n) {
            const Vec3 p = seed % 2 ? random.lattice_point(8) : random.point(1);
            const auto near = [&] {
                return mesh.add_vertex(p + (seed % 2 ? random.lattice_point(1) : 0.1 * random.point(1)));
            };
            const VertexId a = n % 3 ? VertexId{random.below(mesh.vertex_end())} : near(), b = near(), c = near();
            mesh.add_face(a, b, c, 0, 1);
        }
        EXPECT_GT(test::expect_all_crossings_found(mesh), 0u);
    }
}

/// A volume of noise, its vertices moved about.
Mesh shaken(std::uint32_t size, double reach, std::uint64_t seed) {
    Mesh mesh = test::run(test::noise_volume({size, size, size}, 4, seed)).mesh;
    test::Random random(seed);
    test::for_vertices(mesh, [&](VertexId v) { mesh[v].position += random.point(reach); });
    return mesh;
}

TEST(FindCrossings, says_what_all_pairs_say_of_a_shaken_surface) {
    for (double reach : {0.0, 0.02, 0.2, 1.0}) {
        const std::size_t found = test::expect_all_crossings_found(shaken(4, reach, 1));
        EXPECT_EQ(found > 0, reach > 0.1) << reach;
    }
}

TEST(FindCrossings, leaves_out_what_is_not_alive) {
    Mesh mesh = shaken(4, 0.3, 2);
    for (std::uint32_t f = 0; f < mesh.face_end(); f += 3) mesh.remove_face(FaceId{f});
    EXPECT_EQ(test::crossings_in(mesh), test::crossings_by_brute_force(mesh));
}

TEST(FindCrossings, is_the_same_on_any_number_of_threads) {
    const Mesh mesh = shaken(10, 0.3, 3);
    const std::vector<FacePair> expected = test::crossings_in(mesh, 1);
    EXPECT_GT(expected.size(), 100u);
    for (std::uint32_t threads : {2u, 3u, 8u, 0u}) {
        EXPECT_EQ(test::crossings_in(mesh, threads), expected);
        EXPECT_EQ(find_crossings(test::listed_faces(mesh), threads), expected);
    }
}

TEST(FindCrossings, does_not_depend_on_the_order_of_faces) {
    Mesh mesh = shaken(10, 0.3, 3);
    const std::size_t expected = test::crossings_in(mesh).size();
    mesh.sort_spatially();
    EXPECT_EQ(test::crossings_in(mesh).size(), expected);
    std::vector<LabelledFace> faces = test::listed_faces(mesh);
    test::Random random(4);
    for (std::uint32_t n = 1; n < faces.size(); ++n) std::swap(faces[n], faces[random.below(n + 1)]);
    EXPECT_EQ(find_crossings(faces, 1).size(), expected);
}

TEST(FindCrossings, of_nothing_are_none) {
    EXPECT_TRUE(test::crossings_in(Mesh()).empty());
    EXPECT_TRUE(find_crossings(std::span<const LabelledFace>(), 1).empty());
}

}  // namespace
}  // namespace regionmesh
