#include "judge/change.h"

#include <gtest/gtest.h>

#include <map>

#include "base/triangle.h"
#include "judge/verdict/verdicts.h"
#include "mesh/strata.h"
#include "support/runs.h"
#include "support/strata_list.h"

namespace regionmesh {
namespace {

using Volumes = std::map<Label, double>;

void add_face(Volumes& volumes, const std::array<Vec3, 3>& at, const std::array<Label, 2>& labels, double times) {
    const double cone = times * dot(at[0], cross(at[1], at[2])) / 6;
    volumes[labels[0]] += cone;
    volumes[labels[1]] -= cone;
}

Volumes volumes_of(const Mesh& mesh) {
    Volumes volumes;
    for (std::uint32_t f = 0; f < mesh.face_end(); ++f)
        if (mesh.is_alive(FaceId{f})) add_face(volumes, mesh.corners(FaceId{f}), mesh[FaceId{f}].labels, 1);
    return volumes;
}

/// By what the faces of the change say.
Volumes swept_volumes(const Mesh& mesh, const Change& change) {
    std::vector<LabelledTriangle> before, after;
    list_faces_before(mesh, change, before);
    list_faces_after(mesh, change, after);
    Volumes volumes;
    for (const LabelledTriangle& face : before) add_face(volumes, face.at, face.labels, -1);
    for (const LabelledTriangle& face : after) add_face(volumes, face.at, face.labels, 1);
    return volumes;
}

class Changes : public testing::Test {
protected:
    Mesh mesh = test::run(test::grain_volume({10, 10, 10}, 8, 3)).mesh;
    Promises promises{.min_quality = 0};
    Change change;

    void SetUp() override { count_labels(mesh); }

    /// Applies an accepted change; the volumes change as its faces say.
    void apply(Judge& judge) {
        const Volumes swept = swept_volumes(mesh, change), before = volumes_of(mesh);
        judge.apply(change);
        const Volumes after = volumes_of(mesh);
        for (const auto& [label, volume] : after) {
            const auto of_label = swept.find(label);
            const double expected = before.at(label) + (of_label == swept.end() ? 0 : of_label->second);
            ASSERT_NEAR(volume, expected, 1e-9) << label;
        }
    }

    /// Calls visit(u, v) for edges of faces that are alive, until `most` changes were made.
    template <class Visit>
    int for_edges(int most, Visit&& visit) {
        int made = 0;
        for (std::uint32_t f = 0; f < mesh.face_end() && made < most; f += 7)
            if (mesh.is_alive(FaceId{f})) made += visit(mesh[FaceId{f}].vertices[0], mesh[FaceId{f}].vertices[1]);
        return made;
    }
};

TEST_F(Changes, collapses_sweep_what_their_faces_say) {
    Judge judge(mesh, promises);
    const int made = for_edges(40, [&](VertexId u, VertexId v) {
        gather(mesh, u, v, change.star);
        if (examine(judge, change, [&] { return Places{change.star.at_stays}; }) != Verdict::kAccepted) return false;
        apply(judge);
        return true;
    });
    EXPECT_EQ(made, 40);
    test::expect_sound(check(mesh));
}

TEST_F(Changes, moves_sweep_what_their_faces_say) {
    Judge judge(mesh, promises);
    const int made = for_edges(40, [&](VertexId u, VertexId v) {
        if (mesh[u].sides != 0 || mesh[u].label_count != 2) return false;
        gather_move(mesh, u, change.star);
        const Vec3 to = mesh.position(u) + 0.1 * (mesh.position(v) - mesh.position(u)) + Vec3{0.01, 0.02, 0.03};
        if (verdict_at(judge, change, {to}) != Verdict::kAccepted) return false;
        apply(judge);
        return true;
    });
    EXPECT_EQ(made, 40);
    test::expect_sound(check(mesh));
}

TEST_F(Changes, splits_keep_strata_and_sweep_what_their_faces_say) {
    const test::StrataList strata = test::list_strata(mesh);
    const std::uint32_t faces = mesh.face_count();
    int lines = 0;
    {
        Judge judge(mesh, promises);
        const int made = for_edges(60, [&](VertexId u, VertexId v) {
            judge.propose_split(u, v, change);
            lines += mesh[change.star.goes].label_count > 2;
            const bool is_inside = mesh[change.star.goes].sides == 0;
            const Vec3 to = change.star.at_goes + (is_inside ? Vec3{0.01, 0.02, -0.01} : Vec3{});
            if (examine(judge, change, [&] { return Places{to}; }) != Verdict::kAccepted) {
                judge.withdraw(change);
                return false;
            }
            apply(judge);
            EXPECT_EQ(mesh[change.star.goes].label_count, vertex_labels(mesh, change.star.goes).size());
            return true;
        });
        EXPECT_EQ(made, 60);
    }
    EXPECT_GE(mesh.face_count(), faces + 120);
    EXPECT_GT(lines, 3);
    test::expect_same_strata(test::list_strata(mesh), strata);
    test::expect_sound(check(mesh));
}

TEST_F(Changes, a_split_that_meets_another_face_is_refused_and_withdrawn) {
    const std::uint32_t vertices = mesh.vertex_count(), faces = mesh.face_count();
    Judge judge(mesh, promises);
    int refused = 0;
    for_edges(20, [&](VertexId u, VertexId v) {
        judge.propose_split(u, v, change);
        const Vec3 far = change.star.at_goes + Vec3{0, 0, 30};
        refused += examine(judge, change, [&] { return Places{far}; }) != Verdict::kAccepted;
        judge.withdraw(change);
        return true;
    });
    EXPECT_EQ(refused, 20);
    EXPECT_EQ(mesh.vertex_count(), vertices);
    EXPECT_EQ(mesh.face_count(), faces);
}

}  // namespace
}  // namespace regionmesh
