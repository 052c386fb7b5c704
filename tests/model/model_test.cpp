#include "regionmesh/model/model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "regionmesh/check/check.h"
#include "support/digest.h"
#include "support/runs.h"
#include "support/shapes.h"
#include "support/strata_list.h"

namespace regionmesh {
namespace {

std::set<std::uint32_t> star_of(const Model& model, VertexId v) {
    std::set<std::uint32_t> faces;
    model.for_star(v, [&](FaceId f, int place) {
        EXPECT_EQ(model[f].vertices[place], v);
        faces.insert(index(f));
    });
    return faces;
}

/// The stars hold what the faces say.
void expect_stars_of_faces(const Model& model) {
    std::map<std::uint32_t, std::set<std::uint32_t>> stars;
    std::uint32_t faces = 0, vertices = 0;
    test::for_faces(model, [&](FaceId f) {
        ++faces;
        for (VertexId v : model[f].vertices) stars[index(v)].insert(index(f));
    });
    test::for_vertices(model, [&](VertexId v) {
        ++vertices;
        EXPECT_EQ(star_of(model, v), stars[index(v)]);
    });
    EXPECT_EQ(faces, model.face_count());
    EXPECT_EQ(vertices, model.vertex_count());
}

Model grains() { return test::run(test::grain_volume({7, 7, 7}, 6, 1)).model; }

TEST(Model, the_smaller_label_comes_first_and_the_face_is_turned) {
    Model model = test::shape(test::kTetrahedronCorners, {});
    const FaceId f = model.add_face(VertexId{0}, VertexId{1}, VertexId{2}, 5, 3);
    EXPECT_EQ(model[f].labels, (std::array<Label, 2>{3, 5}));
    EXPECT_EQ(model[f].vertices, (std::array{VertexId{0}, VertexId{2}, VertexId{1}}));
}

TEST(Model, freed_places_are_used_again) {
    Model model = test::octahedron();
    test::add_shape(model, {{5, 5, 5}}, {});
    model.remove_face(FaceId{3});
    model.remove_face(FaceId{5});
    model.remove_vertex(VertexId{6});
    EXPECT_FALSE(model.is_alive(FaceId{3}));
    EXPECT_FALSE(model.is_alive(VertexId{6}));
    EXPECT_EQ(model.face_count(), 6u);
    EXPECT_EQ(model.add_vertex({7, 7, 7}), VertexId{6});
    model.add_face(VertexId{0}, VertexId{2}, VertexId{6}, 0, 1);
    model.add_face(VertexId{1}, VertexId{2}, VertexId{6}, 0, 1);
    EXPECT_EQ(model.face_end(), 8u);
    EXPECT_EQ(model.vertex_end(), 7u);
    model.add_face(VertexId{1}, VertexId{3}, VertexId{6}, 0, 1);
    EXPECT_EQ(model.face_end(), 9u) << "no free place was left";
    expect_stars_of_faces(model);
}

TEST(Model, removed_faces_leave_the_stars) {
    Model model = grains();
    for (std::uint32_t f = 0; f < model.face_end(); f += 3) model.remove_face(FaceId{f});
    expect_stars_of_faces(model);
}

TEST(Model, move_star_gives_all_faces_to_the_other_vertex) {
    Model model = test::octahedron();
    const VertexId copy = model.add_vertex(model.position(VertexId{1}));
    const auto before = star_of(model, VertexId{1});
    model.move_star(VertexId{1}, copy);
    EXPECT_EQ(star_of(model, copy), before);
    EXPECT_FALSE(model.is_alive(VertexId{1}));
    EXPECT_EQ(test::surface_digest(model), test::surface_digest(test::octahedron()));
    expect_stars_of_faces(model);
}

TEST(Model, move_star_joins_stars_as_a_collapse_does) {
    Model model = test::edge_in_sheet();
    model.remove_face(FaceId{0});
    model.remove_face(FaceId{1});
    model.move_star(VertexId{0}, VertexId{1});
    EXPECT_EQ(star_of(model, VertexId{1}).size(), 8u);
    expect_stars_of_faces(model);
}

TEST(Model, move_star_of_an_unused_vertex_only_removes_it) {
    Model model = test::octahedron();
    const VertexId lone = model.add_vertex({9, 9, 9});
    model.move_star(lone, VertexId{0});
    EXPECT_EQ(star_of(model, VertexId{0}).size(), 4u);
    EXPECT_EQ(model.vertex_count(), 6u);
}

TEST(Model, sort_spatially_keeps_the_surface_and_names_the_new_ids) {
    Model model = grains();
    for (std::uint32_t f = 0; f < model.face_end(); f += 5) model.remove_face(FaceId{f});
    std::vector<VertexId> unused;
    test::for_vertices(model, [&](VertexId v) {
        if (model[v].star == kNoCorner) unused.push_back(v);
    });
    for (VertexId v : unused) model.remove_vertex(v);
    model[VertexId{0}].is_fixed = true;
    std::vector<Vec3> positions;
    for (std::uint32_t v = 0; v < model.vertex_end(); ++v) positions.push_back(model.position(VertexId{v}));
    std::vector<bool> were_alive;
    for (std::uint32_t v = 0; v < model.vertex_end(); ++v) were_alive.push_back(model.is_alive(VertexId{v}));
    const std::uint64_t before = test::surface_digest(model);

    const std::vector<VertexId> renumbered = model.sort_spatially();
    EXPECT_EQ(test::surface_digest(model), before);
    EXPECT_EQ(model.face_end(), model.face_count());
    EXPECT_EQ(model.vertex_end(), model.vertex_count());
    for (std::uint32_t v = 0; v < positions.size(); ++v) {
        ASSERT_EQ(renumbered[v] != kNoVertex, were_alive[v]);
        if (!were_alive[v]) continue;
        EXPECT_EQ(model.position(renumbered[v]), positions[v]);
    }
    EXPECT_TRUE(model[renumbered[0]].is_fixed);
    expect_stars_of_faces(model);
}

TEST(Model, sort_spatially_puts_near_vertices_near_in_memory) {
    Model model = test::run(test::noise_volume({12, 12, 12}, 3, 1)).model;
    model.sort_spatially();
    double sum = 0;
    for (std::uint32_t v = 1; v < model.vertex_end(); ++v)
        sum += length(model.position(VertexId{v}) - model.position(VertexId{v - 1}));
    EXPECT_LT(sum / model.vertex_end(), 1.0);
}

TEST(Model, sort_spatially_does_not_depend_on_the_order_before) {
    Model model = grains();
    model.sort_spatially();
    const std::uint64_t once = test::digest(model);
    model.sort_spatially();
    EXPECT_EQ(test::digest(model), once);
}

TEST(Model, compact_faces_keeps_order_and_surface) {
    Model model = grains();
    for (std::uint32_t f = 0; f < model.face_end(); f += 2) model.remove_face(FaceId{f});
    std::vector<std::array<VertexId, 3>> expected, found;
    test::for_faces(model, [&](FaceId f) { expected.push_back(model[f].vertices); });
    model.compact_faces();
    EXPECT_EQ(model.face_end(), model.face_count());
    test::for_faces(model, [&](FaceId f) { found.push_back(model[f].vertices); });
    EXPECT_EQ(found, expected);
    expect_stars_of_faces(model);
    model.add_face(VertexId{0}, VertexId{1}, VertexId{2}, 0, 1);
    expect_stars_of_faces(model);
}

TEST(Model, flip_faces_turns_every_face_and_nothing_else) {
    Model model = grains();
    const std::uint64_t before = test::surface_digest(model);
    std::vector<Vec3> normals;
    const auto normal = [&](FaceId f) {
        const auto p = model.corners(f);
        return cross(p[1] - p[0], p[2] - p[0]);
    };
    test::for_faces(model, [&](FaceId f) { normals.push_back(normal(f)); });
    model.flip_faces();
    expect_stars_of_faces(model);
    for (std::uint32_t f = 0; f < normals.size(); ++f) EXPECT_EQ(normal(FaceId{f}), -normals[f]);
    EXPECT_NE(test::surface_digest(model), before);
    model.flip_faces();
    EXPECT_EQ(test::surface_digest(model), before);
}

TEST(Model, random_changes_leave_consistent_stars) {
    Model model = grains();
    std::uint64_t state = 12;
    SCOPED_TRACE("seed 12");
    const auto below = [&](std::uint32_t end) { return static_cast<std::uint32_t>((state = mix64(state)) % end); };
    for (int n = 0; n < 5000; ++n) {
        const FaceId f{below(model.face_end())};
        if (model.is_alive(f)) model.remove_face(f);
        else model.add_face(VertexId{n % 50u}, VertexId{50 + n % 31u}, VertexId{100 + n % 17u}, below(4), 4 + below(4));
    }
    expect_stars_of_faces(model);
}

}  // namespace
}  // namespace regionmesh
