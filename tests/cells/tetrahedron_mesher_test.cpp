#include "cells/tetrahedron_mesher.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "regionmesh/check.h"
#include "regionmesh/error.h"
#include "support/meshes.h"
#include "support/runs.h"

namespace regionmesh {
namespace {

using test::ArrayMesh;
using testing::HasSubstr;

struct Meshed {
    LabelTable labels;
    MeshedStrip strip;
    std::vector<FinalizedVertex> ended;
    LabelOracle oracle;
    bool hull_is_box;
};

/// All in one strip.
Meshed meshed(ArrayMesh mesh, const StripOptions& options = {}) {
    LabelTable labels;
    RankedTetrahedra ranked = rank_tetrahedra(mesh, labels, {.sweep = kSweepZ});
    TetrahedronMesher mesher(ranked.points, mesh, options);
    for (RankedTetrahedron t; ranked.sorted.next(t);) {
        mesher.finalize_before(t.corners[0]);
        mesher.add(t);
    }
    mesher.finalize_all();
    return {std::move(labels), mesher.strip(), mesher.finalized(), mesher.oracle(), mesher.hull_is_box()};
}

std::string meshing_refusal(ArrayMesh mesh) {
    try {
        meshed(std::move(mesh));
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::kInput);
        return error.what();
    }
    return "nothing thrown";
}

/// All of the exterior is one unless the hull is a box.
Mesh mesh_of(const Meshed& made) {
    std::vector<bool> is_on_hull(made.strip.vertices.size());
    for (const FinalizedVertex& end : made.ended) is_on_hull[end.vertex] = end.is_on_hull;
    Mesh mesh;
    for (std::size_t n = 0; n < made.strip.vertices.size(); ++n)
        mesh.add_vertex(made.strip.vertices[n].position, made.hull_is_box ? made.strip.vertices[n].sides
                                                         : is_on_hull[n]  ? kOnHull
                                                                          : SideSet{0});
    for (const ChunkFace& face : made.strip.faces) {
        std::array<Label, 2> labels = face.labels;
        for (Label& label : labels)
            if (is_exterior(label) && !made.hull_is_box) label = exterior(kHull);
        const auto& v = face.vertices;
        mesh.add_face(VertexId{v[0]}, VertexId{v[1]}, VertexId{v[2]}, labels[0], labels[1]);
    }
    return mesh;
}

CheckReport checked(const Meshed& made, const CheckOptions& options = {}) {
    CheckOptions own = options;
    own.oracle = made.oracle;
    return check(mesh_of(made), own);
}

double volume_of(const CheckReport& report) {
    double sum = 0;
    for (const RegionReport& region : report.regions) {
        EXPECT_GT(region.volume, 0);
        sum += region.volume;
    }
    return sum;
}

const std::vector<Vec3> kSkewCorners{{0.1, 0, 0}, {1, 0.2, 0}, {0, 1, 0.3}, {0.2, 0.1, 1}};
double corner_volume() {
    return dot(cross(kSkewCorners[1] - kSkewCorners[0], kSkewCorners[2] - kSkewCorners[0]),
               kSkewCorners[3] - kSkewCorners[0]) /
           6;
}

std::vector<std::vector<InputLabel>> all_labels_of_four() {
    std::vector<std::vector<InputLabel>> all;
    for (InputLabel n = 0; n < 256; ++n) all.push_back({n & 3, n >> 2 & 3, n >> 4 & 3, n >> 6});
    return all;
}

// What the labels say, by looking at all simplices.

using Simplex = std::vector<std::uint32_t>;

std::set<Simplex> simplices_of(const std::vector<LabelledTetrahedron>& tetrahedra, std::size_t size) {
    std::set<Simplex> found;
    for (const LabelledTetrahedron& t : tetrahedra)
        for (unsigned set = 1; set < 16; ++set) {
            Simplex simplex;
            for (int n = 0; n < 4; ++n)
                if (set >> n & 1) simplex.push_back(t.corners[n]);
            std::sort(simplex.begin(), simplex.end());
            if (simplex.size() == size) found.insert(simplex);
        }
    return found;
}

struct Counts {
    std::map<InputLabel, std::int64_t> euler;
    std::uint64_t quadruple_points = 0, pairs = 0;
    friend bool operator==(const Counts&, const Counts&) = default;
};

Counts counts_of(const Meshed& made) {
    Counts counts{{}, made.oracle.quadruple_points_inside, made.oracle.region_pairs};
    for (Label label = 0; label < made.oracle.euler.size(); ++label)
        if (made.oracle.euler[label]) counts.euler[made.labels.input(label)] = made.oracle.euler[label];
    return counts;
}

Counts counts_by_points(const ArrayMesh& mesh) {
    Counts counts;
    std::set<std::set<InputLabel>> pairs;
    for (std::size_t size = 1; size <= 4; ++size)
        for (const Simplex& simplex : simplices_of(mesh.tetrahedra(), size)) {
            std::set<InputLabel> labels;
            for (std::uint32_t p : simplex) labels.insert(mesh.points().labels[p]);
            if (labels.size() == 1) counts.euler[*labels.begin()] += size % 2 ? 2 : -2;
            if (size == 2 && labels.size() == 2) pairs.insert(labels);
            if (labels.size() == 4) ++counts.quadruple_points;
        }
    counts.pairs = pairs.size();
    std::erase_if(counts.euler, [](const auto& item) { return item.second == 0; });
    return counts;
}

constexpr InputLabel kOutside = 1000;

Counts counts_by_cells(const ArrayMesh& mesh) {
    std::map<Simplex, std::multiset<InputLabel>> at_triangle;
    std::map<std::uint32_t, std::set<InputLabel>> at_node;
    for (const LabelledTetrahedron& t : mesh.tetrahedra())
        for (int n = 0; n < 4; ++n) {
            Simplex triangle{t.corners[(n + 1) % 4], t.corners[(n + 2) % 4], t.corners[(n + 3) % 4]};
            std::sort(triangle.begin(), triangle.end());
            at_triangle[triangle].insert(t.label);
            at_node[t.corners[n]].insert(t.label);
        }
    Counts counts;
    std::map<InputLabel, std::vector<LabelledTetrahedron>> boundary;  // triangles; a corner comes twice
    std::set<std::set<InputLabel>> pairs;
    for (const auto& [triangle, labels] : at_triangle) {
        std::set<InputLabel> sides(labels.begin(), labels.end());
        if (labels.size() == 1) {
            sides.insert(kOutside);
            for (std::uint32_t node : triangle) at_node[node].insert(kOutside);
        }
        if (sides.size() == 1) continue;
        if (!sides.contains(kOutside)) pairs.insert(sides);
        for (InputLabel label : sides)
            boundary[label].push_back({{triangle[0], triangle[1], triangle[2], triangle[2]}, 0});
    }
    boundary.erase(kOutside);
    for (const auto& [label, faces] : boundary) {
        std::set<Simplex> edges;
        std::set<std::uint32_t> nodes;
        for (const LabelledTetrahedron& face : faces)
            for (int n = 0; n < 3; ++n) {
                nodes.insert(face.corners[n]);
                const auto [low, high] = std::minmax(face.corners[n], face.corners[(n + 1) % 3]);
                edges.insert({low, high});
            }
        counts.euler[label] = std::int64_t(nodes.size()) - std::int64_t(edges.size()) + std::int64_t(faces.size());
    }
    for (const auto& [node, labels] : at_node)
        if (labels.size() == 4 && !labels.contains(kOutside)) ++counts.quadruple_points;
    counts.pairs = pairs.size();
    std::erase_if(counts.euler, [](const auto& item) { return item.second == 0; });
    return counts;
}

/// Some of the tetrahedra only: a hull with holes, edges and nodes where it touches itself.
ArrayMesh part_of(const ArrayMesh& mesh, std::uint64_t seed) {
    std::vector<LabelledTetrahedron> some;
    for (const LabelledTetrahedron& t : mesh.tetrahedra())
        if (mix64(seed = mix64(seed)) % 3) some.push_back(t);
    return {mesh.points(), some};
}

TEST(TetrahedronMesher, one_tetrahedron_has_0_1_2_5_12_faces_inside) {
    for (const std::vector<InputLabel>& labels : all_labels_of_four())
        for (const std::array<std::uint32_t, 4>& corners : {std::array{0u, 1u, 2u, 3u}, std::array{1u, 0u, 2u, 3u}}) {
            const Meshed made = meshed({{kSkewCorners, labels}, {{corners}}}, {.cap = false});
            const std::size_t count = std::set(labels.begin(), labels.end()).size();
            const bool is_two_against_two = count == 2 && std::ranges::count(labels, labels[0]) == 2;
            const std::array<std::size_t, 5> faces{0, 0, is_two_against_two ? 2u : 1u, 5, 12};
            EXPECT_EQ(made.strip.faces.size(), faces[count]);
        }
}

TEST(TetrahedronMesher, one_tetrahedron_with_caps_is_closed_round_each_label) {
    for (const std::vector<InputLabel>& labels : all_labels_of_four())
        for (bool mirrors : {false, true}) {
            SCOPED_TRACE(testing::PrintToString(labels));
            std::vector<Vec3> points = kSkewCorners;
            if (mirrors)
                for (Vec3& p : points) p.x = -p.x;
            const Meshed made = meshed({{points, labels}, {{{0, 1, 2, 3}}}});
            EXPECT_FALSE(made.hull_is_box);
            const CheckReport report = checked(made);
            test::expect_sound(report);
            EXPECT_EQ(report.regions.size(), std::set(labels.begin(), labels.end()).size());
            EXPECT_NEAR(volume_of(report), std::abs(corner_volume()), 1e-12);
            for (const RegionReport& region : report.regions) EXPECT_EQ(region.euler, 2);
        }
}

TEST(TetrahedronMesher, vertices_lie_at_centroids_far_from_the_origin_too) {
    std::vector<Vec3> points = kSkewCorners;
    const Vec3 far{1 << 20, -(1 << 21), 1 << 22};
    for (Vec3& p : points) p = Vec3{std::round(p.x), std::round(p.y), std::round(p.z)} + far;
    const Meshed made = meshed({{points, {0, 1, 1, 1}}, {{{0, 1, 2, 3}}}}, {.cap = false});
    std::vector<Vec3> found;
    for (const ChunkVertex& vertex : made.strip.vertices) found.push_back(vertex.position - far);
    EXPECT_THAT(found, testing::UnorderedElementsAre(Vec3{0.5, 0, 0}, Vec3{0, 0.5, 0}, Vec3{0, 0, 0.5}));
}

TEST(TetrahedronMesher, labels_at_points_give_sound_models_whatever_the_tetrahedra) {
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        const ArrayMesh mesh = test::bent_mesh({6, 5, 7}, 6, seed);
        const Meshed made = meshed(mesh);
        const CheckReport report = checked(made);
        test::expect_sound(report);
        EXPECT_FALSE(made.hull_is_box);
        double sum = 0;
        for (const LabelledTetrahedron& t : mesh.tetrahedra()) {
            const auto& p = mesh.points().positions;
            sum += std::abs(dot(cross(p[t.corners[1]] - p[t.corners[0]], p[t.corners[2]] - p[t.corners[0]]),
                                p[t.corners[3]] - p[t.corners[0]])) /
                   6;
        }
        EXPECT_NEAR(volume_of(report), sum, 1e-9 * sum);
    }
}

TEST(TetrahedronMesher, counts_of_labels_at_points_are_those_of_all_simplices) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        for (const ArrayMesh& mesh :
             {test::bent_mesh({5, 4, 5}, 6, seed), test::mesh_of(test::noise_volume({4, 4, 4}, 4, seed)),
              part_of(test::mesh_of(test::noise_volume({4, 4, 4}, 3, seed)), seed)}) {
            const Counts expected = counts_by_points(mesh);
            EXPECT_EQ(counts_of(meshed(mesh)), expected);
            EXPECT_EQ(counts_of(meshed(mesh.shuffled(seed))), expected);
            EXPECT_EQ(counts_of(meshed(mesh, {.cap = false, .background = {0}})), expected);
        }
    }
}

TEST(TetrahedronMesher, counts_of_labels_of_tetrahedra_are_those_of_all_simplices) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        for (const ArrayMesh& mesh : {test::cell_mesh_of(test::grain_volume({5, 6, 5}, 6, seed)),
                                      test::cell_mesh_of(test::noise_volume({5, 4, 5}, 3, seed)),
                                      part_of(test::cell_mesh_of(test::noise_volume({4, 4, 4}, 6, seed)), seed)}) {
            const Counts expected = counts_by_cells(mesh);
            EXPECT_EQ(counts_of(meshed(mesh)), expected);
            EXPECT_EQ(counts_of(meshed(mesh.shuffled(seed))), expected);
            EXPECT_EQ(counts_of(meshed(mesh, {.cap = false, .background = {0}})), expected);
        }
    }
}

TEST(TetrahedronMesher, check_counts_of_the_model_what_the_labels_of_tetrahedra_say) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        for (const ArrayMesh& mesh : {test::cell_mesh_of(test::noise_volume({5, 4, 5}, 5, seed)),
                                      part_of(test::cell_mesh_of(test::noise_volume({4, 4, 4}, 6, seed)), seed)}) {
            const CheckReport report = checked(meshed(mesh));
            for (ViolationKind kind :
                 {ViolationKind::kEuler, ViolationKind::kQuadruplePoints, ViolationKind::kRegionPairs,
                  ViolationKind::kOpenEdge, ViolationKind::kOrientation, ViolationKind::kDuplicateFace,
                  ViolationKind::kCrossingFaces})
                EXPECT_EQ(report.counts[static_cast<int>(kind)], 0u) << to_string(kind);
        }
    }
}

TEST(TetrahedronMesher, labels_of_tetrahedra_keep_their_volumes) {
    const Meshed made = meshed(test::cell_mesh_of(test::grain_volume({6, 5, 7}, 5, 3)));
    EXPECT_TRUE(made.hull_is_box);
    EXPECT_NEAR(volume_of(checked(made)), 5 * 4 * 6, 1e-12);
}

TEST(TetrahedronMesher, faces_on_the_hull_are_made_of_caps_only) {
    const ArrayMesh mesh = test::bent_mesh({5, 5, 5}, 5, 2);
    for (const ArrayMesh& given : {mesh, ArrayMesh{{mesh.points().positions, {}}, mesh.tetrahedra()}}) {
        const auto outer = [](const Meshed& made) {
            return std::ranges::count_if(made.strip.faces, [](const ChunkFace& f) { return is_exterior(f.labels[1]); });
        };
        const Meshed whole = meshed(given), open = meshed(given, {.cap = false});
        EXPECT_GT(outer(whole), 0);
        EXPECT_EQ(outer(open), 0);
        EXPECT_EQ(open.strip.faces.size() + static_cast<std::size_t>(outer(whole)), whole.strip.faces.size());
        for (const ChunkFace& face : whole.strip.faces) EXPECT_FALSE(is_exterior(face.labels[0]));
    }
}

TEST(TetrahedronMesher, background_has_no_faces_with_the_exterior) {
    const Meshed made = meshed(test::bent_mesh({5, 5, 5}, 3, 2), {.background = {0, 2}});
    EXPECT_TRUE(std::ranges::any_of(made.strip.faces, [](const ChunkFace& f) { return is_exterior(f.labels[1]); }));
    for (const ChunkFace& face : made.strip.faces) EXPECT_TRUE(!is_exterior(face.labels[1]) || face.labels[0] == 1);
    test::expect_sound(checked(made, {.background = {0, 2}}));
}

TEST(TetrahedronMesher, every_vertex_ends_once_and_knows_whether_it_is_on_the_hull) {
    for (const ArrayMesh& mesh :
         {test::bent_mesh({6, 5, 7}, 6, 1), test::cell_mesh_of(test::noise_volume({5, 4, 5}, 3, 1))}) {
        const Meshed made = meshed(mesh);
        std::vector<bool> is_outer(made.strip.vertices.size());
        for (const ChunkFace& face : made.strip.faces)
            if (is_exterior(face.labels[1]))
                for (std::uint32_t v : face.vertices) is_outer[v] = true;
        std::vector<int> ends(made.strip.vertices.size());
        for (const FinalizedVertex& end : made.ended) {
            ++ends[end.vertex];
            EXPECT_EQ(end.is_on_hull, is_outer[end.vertex]);
            EXPECT_FALSE(end.is_shared);
            EXPECT_FALSE(end.is_pinned);
        }
        EXPECT_THAT(ends, testing::Each(1));
    }
}

TEST(TetrahedronMesher, three_tetrahedra_at_a_triangle_are_refused) {
    std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -1}, {0.1, 0.1, 2}};
    for (const std::vector<InputLabel>& labels : {std::vector<InputLabel>(6, 1), {}}) {
        const std::string said =
            meshing_refusal({{points, labels}, {{{0, 1, 2, 3}, 1}, {{0, 1, 2, 4}, 2}, {{0, 1, 2, 5}, 3}}});
        for (const char* part : {"mesh: three tetrahedra", "node 0", "node 1", "node 2", "mend the mesh"})
            EXPECT_THAT(said, HasSubstr(part));
    }
}

TEST(TetrahedronMesher, two_tetrahedra_on_one_side_of_a_triangle_are_refused) {
    std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.1, 0.1, 2}};
    for (const std::vector<InputLabel>& labels : {std::vector<InputLabel>(5, 1), {}}) {
        const std::string said = meshing_refusal({{points, labels}, {{{0, 1, 2, 3}, 1}, {{2, 1, 4, 0}, 1}}});
        for (const char* part : {"mesh: two tetrahedra", "same side", "node 0", "node 1", "node 2"})
            EXPECT_THAT(said, HasSubstr(part));
        EXPECT_THAT(meshing_refusal({{points, labels}, {{{0, 1, 2, 3}, 1}, {{3, 1, 2, 0}, 1}}}), HasSubstr("same side"))
            << "the same one twice";
    }
}

}  // namespace
}  // namespace regionmesh
