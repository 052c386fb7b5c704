// Models that are not sound come out no worse, whatever is wrong with them.
#include <gtest/gtest.h>

#include <map>
#include <string>

#include "regionmesh/check.h"
#include "regionmesh/simplify.h"
#include "regionmesh/smooth.h"
#include "support/damage.h"
#include "support/random.h"
#include "support/runs.h"
#include "support/shapes.h"

namespace regionmesh {
namespace {

void expect_no_worse(const CheckReport& before, const CheckReport& after) {
    for (int kind = 0; kind < kViolationKindCount; ++kind)
        EXPECT_LE(after.counts[kind], before.counts[kind]) << to_string(static_cast<ViolationKind>(kind));
}

/// Euler characteristic and parts of each region's boundary.
std::map<Label, std::pair<std::int64_t, std::uint32_t>> topology_of(const CheckReport& report) {
    std::map<Label, std::pair<std::int64_t, std::uint32_t>> topology;
    for (const RegionReport& region : report.regions) topology[region.label] = {region.euler, region.components};
    return topology;
}

class Damaged : public testing::TestWithParam<test::Damage> {
protected:
    static Mesh mesh_of(std::uint64_t seed) {
        Mesh mesh = test::run(test::grain_volume({9, 9, 9}, 7, seed)).mesh;
        test::damage(mesh, GetParam(), 12, seed);
        return mesh;
    }
};

std::string name_of(const testing::TestParamInfo<test::Damage>& tested) {
    constexpr const char* kNames[] = {"cracks",       "moved_vertices", "split_vertices",
                                      "turned_faces", "other_labels",   "fins"};
    return kNames[static_cast<int>(tested.param)];
}
INSTANTIATE_TEST_SUITE_P(, Damaged, testing::ValuesIn(test::kDamages), name_of);

TEST_P(Damaged, model_is_decimated_and_no_worse) {
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
        SCOPED_TRACE(seed);
        Mesh mesh = mesh_of(seed);
        const CheckReport before = check(mesh);
        EXPECT_GT(before.violation_count(), 0u);
        const std::uint32_t faces = mesh.face_count();
        mesh.sort_spatially();
        const LockedPart fixed = lock_violations(mesh, {});
        EXPECT_GT(fixed.vertices, 0u);
        EXPECT_LT(fixed.vertices, mesh.vertex_count() / 2) << "more than what is broken was fixed";
        simplify(mesh, {.target_faces = faces / 4});
        const CheckReport after = check(mesh);
        expect_no_worse(before, after);
        EXPECT_EQ(topology_of(before), topology_of(after));
        EXPECT_LT(mesh.face_count(), 3 * faces / 4);
    }
}

TEST_P(Damaged, model_is_smoothed_and_no_worse) {
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
        SCOPED_TRACE(seed);
        for (const SmoothFilter filter : {SmoothFilter::kTaubin, SmoothFilter::kNifpms}) {
            Mesh mesh = mesh_of(seed);
            const CheckReport before = check(mesh);
            lock_violations(mesh, {});
            const std::vector<Vec3> places = [&] {
                std::vector<Vec3> all;
                for (std::uint32_t v = 0; v < mesh.vertex_end(); ++v) all.push_back(mesh.position(VertexId{v}));
                return all;
            }();
            EXPECT_GT(smooth(mesh, {.filter = filter}).largest_displacement, 0);
            expect_no_worse(before, check(mesh));
            for (std::uint32_t v = 0; v < mesh.vertex_end(); ++v)
                EXPECT_TRUE(!mesh[VertexId{v}].is_fixed || mesh.position(VertexId{v}) == places[v]);
        }
    }
}

TEST(Unsound, nothing_is_fixed_in_a_sound_model) {
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        SCOPED_TRACE(seed);
        for (const bool cap : {true, false}) {
            ReconstructOptions options = test::plain();
            options.cap = cap;
            options.background = {0, 3};
            Reconstruction made = test::run(test::noise_volume({7, 6, 5}, 5, seed), options);
            EXPECT_EQ(lock_violations(made.mesh, {.boundary_is_open = !cap, .background = made.background}).vertices,
                      0u);
        }
    }
}

/// Four leaves of a book round the edge 0-1, each a tetrahedron of its own region.
Mesh book_of_four() {
    Mesh mesh;
    for (const double z : {0.0, 1.0}) mesh.add_vertex({0, 0, z});
    for (const Vec3 p : {Vec3{1, 0, 0.5}, Vec3{0, 1, 0.5}, Vec3{-1, 0, 0.5}, Vec3{0, -1, 0.5}}) mesh.add_vertex(p);
    const VertexId low{0}, high{1};
    for (std::uint32_t n = 0; n < 4; ++n) {
        const VertexId here{2 + n}, next{2 + (n + 1) % 4};
        mesh.add_face(low, here, high, n, (n + 3) % 4);
        mesh.add_face(low, next, here, n, 9);
        mesh.add_face(high, here, next, n, 9);
    }
    return mesh;
}

TEST(Unsound, edge_of_four_regions_is_found_and_stays) {
    Mesh mesh = book_of_four();
    const CheckReport report = check(mesh);
    EXPECT_EQ(report.violation_count(), 2u);
    EXPECT_EQ(report.counts[static_cast<int>(ViolationKind::kNonGenericVertex)], 2u);
    lock_violations(mesh, {});
    EXPECT_TRUE(mesh[VertexId{0}].is_fixed && mesh[VertexId{1}].is_fixed);
    EXPECT_FALSE(mesh[VertexId{2}].is_fixed);
}

TEST(Unsound, two_regions_that_touch_in_a_point_are_found) {
    // Each is sound, and what is outside is one exterior without sides.
    Mesh mesh = test::shape(test::kTetrahedronCorners, test::tetrahedron_faces(0, exterior(0)));
    const VertexId o{0}, x = mesh.add_vertex({-1, 0, 0}), y = mesh.add_vertex({0, -1, 0}),
                         z = mesh.add_vertex({0, 0, -1});
    for (auto [a, b, c] : {std::array{o, x, y}, std::array{o, z, x}, std::array{o, y, z}, std::array{x, z, y}})
        mesh.add_face(a, b, c, 2, exterior(0));
    const CheckReport report = check(mesh);
    ASSERT_EQ(report.violations.size(), 1u);
    EXPECT_EQ(report.violations[0].kind, ViolationKind::kNonGenericVertex);
    EXPECT_EQ(report.violations[0].at, (Vec3{0, 0, 0}));
    EXPECT_EQ(report.violations[0].labels, (std::vector<Label>{0, 2, exterior(0)}));
    EXPECT_EQ(lock_violations(mesh, {}).vertices, 1u);
}

/// Any faces between any vertices; in every second soup many vertices coincide and many faces are degenerate.
Mesh soup(std::uint64_t seed) {
    test::Random random(seed);
    Mesh mesh;
    const std::uint32_t vertices = 3 + random.below(12);
    for (std::uint32_t v = 0; v < vertices; ++v)
        mesh.add_vertex(seed % 2 == 0 ? random.lattice_point(1) : random.point(1));
    for (std::uint32_t f = random.below(60); f > 0; --f) {
        const auto corner = [&] { return VertexId{random.below(vertices)}; };
        const auto label = [&] { return random.below(30) == 0 ? exterior(0) : static_cast<Label>(random.below(20)); };
        mesh.add_face(corner(), corner(), corner(), label(), label());
    }
    return mesh;
}

TEST(Unsound, soups_of_faces_are_told_and_come_to_no_harm) {
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        SCOPED_TRACE(seed);
        Mesh mesh = soup(seed), smoothed = soup(seed);
        const CheckReport before = check(mesh, {.threads = 1});
        mesh.sort_spatially();
        lock_violations(mesh, {.threads = 1});
        simplify(mesh, {.target_faces = 0});
        expect_no_worse(before, check(mesh, {.threads = 1}));
        lock_violations(smoothed, {.threads = 1});
        smooth(smoothed, {.threads = 1});
        expect_no_worse(before, check(smoothed, {.threads = 1}));
    }
}

}  // namespace
}  // namespace regionmesh
