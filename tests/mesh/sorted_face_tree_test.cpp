#include "mesh/sorted_face_tree.h"

#include <gtest/gtest.h>

#include <set>

#include "mesh/extent.h"
#include "mesh/face_meeting.h"
#include "support/random.h"
#include "support/runs.h"

namespace regionmesh {
namespace {

/// The same surface with faces and vertices in no order, and with free places.
Mesh shuffled(const Mesh& mesh, std::uint64_t seed) {
    test::Random random(seed);
    std::vector<std::uint32_t> vertices(mesh.vertex_end()), faces(mesh.face_end()), place(mesh.vertex_end());
    for (std::uint32_t n = 0; n < vertices.size(); ++n) vertices[n] = n;
    for (std::uint32_t n = 0; n < faces.size(); ++n) faces[n] = n;
    for (std::uint32_t n = 1; n < vertices.size(); ++n) std::swap(vertices[n], vertices[random.below(n + 1)]);
    for (std::uint32_t n = 1; n < faces.size(); ++n) std::swap(faces[n], faces[random.below(n + 1)]);
    Mesh result;
    for (std::uint32_t v : vertices) place[v] = index(result.add_vertex(mesh.position(VertexId{v})));
    for (std::uint32_t f : faces) {
        const auto& face = mesh[FaceId{f}];
        const auto at = [&](int n) { return VertexId{place[index(face.vertices[n])]}; };
        result.add_face(at(0), at(1), at(2), face.labels[0], face.labels[1]);
    }
    for (std::uint32_t f = 0; f < result.face_end(); f += 10) result.remove_face(FaceId{f});
    return result;
}

using Pairs = std::set<std::pair<std::uint32_t, std::uint32_t>>;

Pairs pairs_in(const SortedFaceTree& tree) {
    Pairs pairs;
    for (std::uint32_t part = 0; part < tree.boxes().part_count(); ++part) {
        tree.boxes().visit_pairs(part, part + 1, [&](const GridTree::PartPairs& some) {
            for (const GridTree::Pair pair : some.pairs) {
                const std::uint32_t f = index(tree.face(some.first_m + pair.m()));
                const std::uint32_t g = index(tree.face(some.first_n + pair.n()));
                EXPECT_TRUE(pairs.insert({std::min(f, g), std::max(f, g)}).second);
            }
        });
    }
    return pairs;
}

TEST(SortedFaceTree, finds_all_pairs_and_faces_whatever_their_order) {
    const Mesh made = test::run(test::noise_volume({7, 7, 7}, 4, 3)).mesh;
    for (const Mesh& mesh : {shuffled(made, 1), shuffled(made, 2)}) {
        const SortedFaceTree tree(mesh, 1);
        const Pairs pairs = pairs_in(tree);
        test::for_faces(mesh, [&](FaceId f) {
            std::set<FaceId> found;
            tree.search(box_of(mesh, f), [&](FaceId g) { return found.insert(g).second; });
            test::for_faces(mesh, [&](FaceId g) {
                if (!boxes_overlap(mesh.corners(f), mesh.corners(g))) return;
                EXPECT_TRUE(found.contains(g));
                EXPECT_TRUE(f >= g || pairs.contains({index(f), index(g)}));
            });
        });
    }
}

TEST(SortedFaceTree, sorts_what_is_in_no_order) {
    Mesh sorted = test::run(test::noise_volume({12, 12, 12}, 4, 3)).mesh;
    const Mesh disordered = shuffled(sorted, 1);
    sorted.sort_spatially();
    EXPECT_EQ(SortedFaceTree(sorted, 1).face(12345), FaceId{12345}) << "in its own order";
    const SortedFaceTree tree(disordered, 1);
    EXPECT_TRUE(tree.boxes().is_spatial());
    double step = 0;
    const std::uint32_t faces = disordered.face_count();
    for (std::uint32_t n = 1; n < faces; ++n)
        step += length(disordered.corners(tree.face(n))[0] - disordered.corners(tree.face(n - 1))[0]);
    EXPECT_LT(step / faces, 1.5) << "from one face to the next";
}

TEST(SortedFaceTree, of_nothing_finds_nothing) {
    const SortedFaceTree tree(Mesh(), 1);
    tree.search({{0, 0, 0}, {1, 1, 1}}, [](FaceId) {
        ADD_FAILURE();
        return true;
    });
    EXPECT_TRUE(pairs_in(tree).empty());
}

}  // namespace
}  // namespace regionmesh
