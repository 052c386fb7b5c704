#include "stream/star_watch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "support/meshes.h"

namespace regionmesh {
namespace {

using test::ArrayMesh;
using testing::UnorderedElementsAre;

struct Watched {
    Mesh whole;  // vertices have the ids of the strips
    std::set<std::uint32_t> pinned;
    std::vector<Vec3> places() const {
        std::vector<Vec3> at;
        for (std::uint32_t v : pinned) at.push_back(whole.position(VertexId{v}));
        return at;
    }
};

/// Strips of so many tetrahedra each.
Watched watched(ArrayMesh mesh, const StripOptions& options = {}, std::uint32_t per_strip = 20) {
    LabelTable labels;
    RankedTetrahedra ranked = rank_tetrahedra(mesh, labels, {.sweep = kSweepZ});
    TetrahedronMesher mesher(ranked.points, mesh, options);
    StarWatch watch(options);
    Watched result;
    std::uint32_t ended = 0;
    test::mesh_in_strips(ranked, mesher, per_strip, [&] {
        watch.add(mesher.strip());
        watch.judge(mesher.finalized());
        for (const ChunkVertex& vertex : mesher.strip().vertices) result.whole.add_vertex(vertex.position);
        for (const ChunkFace& face : mesher.strip().faces) {
            const auto& v = face.vertices;
            result.whole.add_face(VertexId{v[0]}, VertexId{v[1]}, VertexId{v[2]}, face.labels[0],
                                  is_exterior(face.labels[1]) ? exterior(kHull) : face.labels[1]);
        }
        for (const FinalizedVertex& end : mesher.finalized()) {
            if (end.is_pinned) result.pinned.insert(end.vertex);
            if (end.is_on_hull) result.whole[VertexId{end.vertex}].sides = kOnHull;
            ++ended;
        }
    });
    EXPECT_EQ(ended, result.whole.vertex_end());
    return result;
}

/// In the model as a whole.
std::set<std::uint32_t> not_generic(const Mesh& mesh, const StripOptions& options) {
    const CheckOptions check{.boundary_is_open = !options.cap, .background = options.background};
    GenericStar generic(mesh, check);
    std::set<std::uint32_t> found;
    for (std::uint32_t v = 0; v < mesh.vertex_end(); ++v)
        if (generic.fault(VertexId{v}) != StarFault::kNone) found.insert(v);
    return found;
}

const std::vector<Vec3> kPoints{{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {-1, 0, -1}};

TEST(StarWatch, two_tetrahedra_that_share_an_edge_are_pinned_at_it) {
    for (const std::vector<InputLabel>& labels : {std::vector<InputLabel>(7, 1), {}})
        EXPECT_THAT(watched({{kPoints, labels}, {{{0, 1, 2, 3}, 1}, {{0, 1, 4, 5}, 1}}}).places(),
                    UnorderedElementsAre(kPoints[0], kPoints[1]));
    // As two regions they are two fans of the exterior all the same.
    EXPECT_THAT(watched({{kPoints, {}}, {{{0, 1, 2, 3}, 1}, {{0, 1, 4, 5}, 2}}}).places(),
                UnorderedElementsAre(kPoints[0], kPoints[1]));
}

TEST(StarWatch, two_tetrahedra_that_share_a_node_are_pinned_there) {
    for (const std::vector<InputLabel>& labels : {std::vector<InputLabel>(7, 1), {}})
        for (std::uint32_t per_strip : {1u, 2u, 20u})
            EXPECT_THAT(watched({{kPoints, labels}, {{{0, 1, 2, 3}, 1}, {{0, 4, 5, 6}, 1}}}, {}, per_strip).places(),
                        UnorderedElementsAre(kPoints[0]));
}

TEST(StarWatch, meshes_that_touch_themselves_nowhere_are_pinned_nowhere) {
    for (std::uint64_t seed : {1, 2, 3}) {
        EXPECT_TRUE(watched(test::bent_mesh({6, 5, 7}, 6, seed)).pinned.empty());
        EXPECT_TRUE(watched(test::bent_mesh({6, 5, 7}, 6, seed), {.cap = false}).pinned.empty());
    }
    for (const std::vector<InputLabel>& labels : {std::vector<InputLabel>(7, 1), {}})
        EXPECT_TRUE(watched({{kPoints, labels}, {{{0, 1, 2, 3}, 1}}}).pinned.empty());
}

TEST(StarWatch, pins_what_is_not_generic_in_the_model_as_a_whole) {
    for (std::uint64_t seed : {1, 2, 3}) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        for (const ArrayMesh& mesh : {test::cell_mesh_of(test::noise_volume({5, 5, 6}, 3, seed)),
                                      test::cell_mesh_of(test::grain_volume({6, 5, 6}, 8, seed)),
                                      test::mesh_of(test::noise_volume({4, 4, 6}, 3, seed))})
            for (const StripOptions& options : {StripOptions{}, {.cap = false}, {.background = {0}}})
                for (std::uint32_t per_strip : {1u, 20u, 100000u}) {
                    const Watched found = watched(mesh, options, per_strip);
                    EXPECT_EQ(found.pinned, not_generic(found.whole, options));
                }
    }
}

TEST(StarWatch, noise_of_tetrahedra_is_pinned_somewhere) {
    EXPECT_GT(watched(test::cell_mesh_of(test::noise_volume({5, 5, 6}, 3, 1))).pinned.size(), 10u);
}

}  // namespace
}  // namespace regionmesh
