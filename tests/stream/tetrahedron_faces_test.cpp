#include "stream/tetrahedron_faces.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "regionmesh/error.h"
#include "regionmesh/reconstruct.h"
#include "support/digest.h"
#include "support/meshes.h"
#include "support/runs.h"
#include "support/strata_list.h"

namespace regionmesh {
namespace {

using test::by_cells;
using test::carved;
using test::expect_sound;
using test::plain;
using test::reduced;
using test::run;
using test::surface_digest;

void expect_same_surface(const Reconstruction& a, const Reconstruction& b) {
    expect_sound(a.report.check);
    expect_sound(b.report.check);
    EXPECT_EQ(a.report.initial_faces, b.report.initial_faces);
    EXPECT_EQ(a.report.initial_vertices, b.report.initial_vertices);
    EXPECT_EQ(a.mesh.face_count(), b.mesh.face_count());
    EXPECT_EQ(a.mesh.vertex_count(), b.mesh.vertex_count());
    EXPECT_EQ(surface_digest(a.mesh), surface_digest(b.mesh));
    ASSERT_EQ(a.report.check.regions.size(), b.report.check.regions.size());
    for (std::size_t n = 0; n < a.report.check.regions.size(); ++n) {
        EXPECT_EQ(a.report.check.regions[n].label, b.report.check.regions[n].label);
        EXPECT_EQ(a.report.check.regions[n].euler, b.report.check.regions[n].euler);
    }
}

TEST(TetrahedronFaces, a_lattice_as_tetrahedra_is_the_model_of_its_sections) {
    for (const test::ArrayVolume& volume :
         {test::grain_volume({17, 14, 12}, 8, 1), test::noise_volume({9, 8, 10}, 5, 2), test::solid_volume({4, 3, 5})})
        for (ReconstructOptions options :
             {plain(), ReconstructOptions{.smooth = {.passes = 0}, .decimate = false},
              ReconstructOptions{.smooth = {.passes = 0}, .decimate = false, .cap = false}}) {
            options.cells = CellKind::kTetrahedra;
            test::ArrayVolume sections = volume;
            expect_same_surface(run(test::mesh_of(volume), options), test::run(sections, options));
        }
}

TEST(TetrahedronFaces, a_lattice_as_tetrahedra_is_smoothed_and_decimated_as_its_sections_are) {
    for (const test::ArrayVolume& volume :
         {test::grain_volume({30, 28, 40}, 20, 1), test::noise_volume({9, 8, 10}, 5, 2)})
        for (ReconstructOptions options : {ReconstructOptions{.decimate = false, .background = {}}, reduced(0.9),
                                           ReconstructOptions{.reduce = 0.9, .background = {}}}) {
            options.smooth.filter = SmoothFilter::kTaubin;
            options.keep_samples = false;  // tetrahedra have no lattice of samples
            test::ArrayVolume sections = volume;
            expect_same_surface(run(test::mesh_of(volume), options), test::run(sections, options));
        }
}

double volume_of(const test::ArrayMesh& mesh) {
    double sum = 0;
    const auto& p = mesh.points().positions;
    for (const LabelledTetrahedron& t : mesh.tetrahedra()) {
        const Vec3 a = p[t.corners[0]];
        sum += std::abs(dot(cross(p[t.corners[1]] - a, p[t.corners[2]] - a), p[t.corners[3]] - a)) / 6;
    }
    return sum;
}

std::map<InputLabel, double> volumes_of(const Reconstruction& made) {
    std::map<InputLabel, double> volumes;
    for (const RegionReport& region : made.report.check.regions)
        volumes[made.labels.input(region.label)] = region.volume;
    return volumes;
}

double sum_of(const std::map<InputLabel, double>& volumes) {
    double sum = 0;
    for (const auto& [label, volume] : volumes) sum += volume;
    return sum;
}

/// Options that touch all stages.
std::vector<ReconstructOptions> stages() {
    return {plain(),
            {.decimate = false, .background = {}},
            reduced(0.9),
            {.reduce = 0.9, .background = {}},
            {.reduce = 0.9, .preserve_volume = true, .background = {}},
            {.reduce = 0.9, .cap = false, .background = {}},
            {.reduce = 0.9, .background = {0, 2}}};
}

TEST(TetrahedronFaces, bent_meshes_stay_sound_in_all_stages) {
    for (std::uint64_t seed : {1, 2}) {
        const test::ArrayMesh mesh = test::bent_mesh({12, 10, 14}, 8, seed);
        for (std::size_t n = 0; n < stages().size(); ++n) {
            SCOPED_TRACE("seed " + std::to_string(seed) + ", options " + std::to_string(n));
            const Reconstruction made = run(mesh, stages()[n]);
            expect_sound(made.report.check);
            if (stages()[n].reduce) {
                EXPECT_LE(made.report.final_faces, (made.report.initial_faces + 9) / 10);
            }
        }
    }
}

TEST(TetrahedronFaces, noise_at_the_points_of_a_bent_mesh_stays_sound) {
    const test::ArrayMesh bent = test::bent_mesh({8, 7, 9}, 2, 5);
    const test::ArrayMesh mesh{{bent.points().positions, test::noise_volume({8, 7, 9}, 5, 1).labels()},
                               bent.tetrahedra()};
    for (const ReconstructOptions& options : stages()) {
        const Reconstruction made = run(mesh, options);
        expect_sound(made.report.check);
    }
}

TEST(TetrahedronFaces, strata_are_those_of_the_plain_model_after_smoothing_and_decimation) {
    for (const test::ArrayMesh& mesh :
         {test::bent_mesh({14, 12, 16}, 8, 3), test::mesh_of(test::grain_volume({12, 10, 14}, 8, 3))}) {
        const test::StrataList expected = test::list_strata(run(mesh).mesh);
        for (const ReconstructOptions& options : {reduced(0.9), ReconstructOptions{.reduce = 0.8, .background = {}}})
            test::expect_same_strata(test::list_strata(run(mesh, options).mesh), expected);
    }
}

TEST(TetrahedronFaces, every_sweep_is_sound_and_keeps_the_volumes) {
    const test::ArrayMesh mesh = test::bent_mesh({10, 12, 9}, 6, 4);
    const std::map<InputLabel, double> volumes = volumes_of(run(mesh));
    EXPECT_NEAR(sum_of(volumes), volume_of(mesh), 1e-9 * volume_of(mesh));
    for (const Sweep& sweep : {kSweepX, kSweepY, kSweepZ}) {
        ReconstructOptions options = plain();
        options.sweep = sweep;
        for (const auto& [label, volume] : volumes_of(run(mesh, options)))
            EXPECT_NEAR(volume, volumes.at(label), 1e-9 * volume);
        for (const ReconstructOptions& more : stages()) {
            options = more;
            options.sweep = sweep;
            expect_sound(run(mesh, options).report.check);
        }
    }
}

void expect_volumes_preserved(const test::ArrayMesh& mesh) {
    const std::map<InputLabel, double> volumes = volumes_of(run(mesh));
    for (double share : {0.0, 0.5, 0.9}) {
        SCOPED_TRACE("reduced by " + std::to_string(share));
        const Reconstruction made = run(mesh, {.reduce = share, .preserve_volume = true, .background = {}});
        expect_sound(made.report.check);
        EXPECT_EQ(made.report.preserved.regions_off, 0u);
        EXPECT_LE(made.report.preserved.drift, made.report.preserved.drift_before);
        for (const auto& [label, volume] : volumes_of(made)) EXPECT_NEAR(volume, volumes.at(label), 1e-6 * volume);
    }
}

TEST(TetrahedronFaces, volumes_are_preserved_in_a_box) {
    expect_volumes_preserved(test::mesh_of(test::grain_volume({14, 12, 16}, 8, 3)));
}

/// Decimation changes what the hull holds; as long as its vertices stay, regions cannot have their volumes back.
TEST(TetrahedronFaces, volumes_are_preserved_in_a_hull_that_is_no_box) {
    expect_volumes_preserved(test::bent_mesh({14, 12, 16}, 8, 3));
}

TEST(TetrahedronFaces, model_of_a_scaled_mesh_is_in_the_coordinates_of_the_file) {
    const test::ArrayMesh mesh = test::bent_mesh({10, 9, 8}, 6, 4);
    const std::map<InputLabel, double> volumes = volumes_of(run(mesh));
    for (double scale : {7.0, 0.1}) {
        test::ArrayMesh scaled = mesh;
        scaled.scaled(scale);
        const Reconstruction made = run(scaled);
        expect_sound(made.report.check);
        EXPECT_NEAR(sum_of(volumes_of(made)), volume_of(mesh), 1e-9 * volume_of(mesh));
        for (const auto& [label, volume] : volumes_of(made)) EXPECT_NEAR(volume, volumes.at(label), 1e-9 * volume);
        for (const ReconstructOptions& options : stages()) {
            const Reconstruction other = run(scaled, options);
            expect_sound(other.report.check);
            if (options.preserve_volume) continue;
            test::for_vertices(other.mesh, [&](VertexId v) { EXPECT_NEAR(other.mesh.position(v).z, 3.5, 4.5); });
        }
    }
}

TEST(TetrahedronFaces, a_cavity_and_two_pieces_are_regions_as_they_are) {
    const test::Size size{8, 7, 9};
    const test::ArrayMesh solid = test::mesh_of(test::solid_volume(size)),
                          grains = test::mesh_of(test::grain_volume(size, 5, 2));
    const auto has_cavity = [](auto x, auto y, auto z) { return x < 3 || x > 4 || y < 2 || y > 3 || z < 3 || z > 4; };
    const auto has_gap = [](auto, auto, auto z) { return z < 3 || z > 4; };
    const Reconstruction hollow = run(carved(solid, size, has_cavity)), parted = run(carved(solid, size, has_gap));
    ASSERT_EQ(hollow.report.check.regions.size(), 1u);
    EXPECT_EQ(hollow.report.check.regions[0].components, 2u);
    EXPECT_EQ(hollow.report.check.regions[0].euler, 4);
    EXPECT_NEAR(hollow.report.check.regions[0].volume, 7 * 6 * 8 - 8, 1e-9);
    EXPECT_EQ(parted.report.check.regions[0].components, 2u);
    EXPECT_NEAR(parted.report.check.regions[0].volume, 7 * 6 * 6, 1e-9);
    for (const test::ArrayMesh& mesh : {carved(solid, size, has_cavity), carved(solid, size, has_gap),
                                        carved(grains, size, has_cavity), carved(grains, size, has_gap)})
        for (const ReconstructOptions& options : stages()) expect_sound(run(mesh, options).report.check);
    expect_sound(run(by_cells(carved(solid, size, has_cavity)), {.reduce = 0.9, .background = {}}).report.check);
}

TEST(TetrahedronFaces, one_tetrahedron_with_one_to_four_labels_goes_all_the_way) {
    const std::vector<Vec3> corners{{0.1, 0, 0}, {1, 0.2, 0}, {0, 1, 0.3}, {0.2, 0.1, 1}};
    for (const std::vector<InputLabel>& labels :
         {std::vector<InputLabel>{7, 7, 7, 7}, {7, 7, 7, 8}, {7, 8, 7, 8}, {7, 8, 9, 7}, {-7, 8, 9, 10}, {}})
        for (const ReconstructOptions& options : stages()) {
            const test::ArrayMesh mesh{{corners, labels}, {{{3, 1, 2, 0}, 5}}};
            const Reconstruction made = run(mesh, options);
            expect_sound(made.report.check);
            if (options.cap && !options.reduce && options.smooth.passes == 0) {
                EXPECT_NEAR(sum_of(volumes_of(made)), volume_of(mesh), 1e-12);
            }
        }
}

TEST(TetrahedronFaces, labels_of_cells_give_the_boundaries_between_them) {
    const test::ArrayVolume volume = test::grain_volume({9, 8, 10}, 6, 2);
    const Reconstruction made = run(test::cell_mesh_of(volume));
    std::map<InputLabel, double> cells;
    for (std::uint32_t z = 0; z < 9; ++z)
        for (std::uint32_t y = 0; y < 7; ++y)
            for (std::uint32_t x = 0; x < 8; ++x) ++cells[volume.at(x, y, z)];
    EXPECT_EQ(volumes_of(made).size(), cells.size());
    for (const auto& [label, count] : volumes_of(made)) EXPECT_NEAR(count, cells.at(label), 1e-9);
    test::for_vertices(made.mesh, [&](VertexId v) {
        const Vec3 p = made.mesh.position(v);
        for (int axis = 0; axis < 3; ++axis) EXPECT_EQ(p[axis], std::round(p[axis]));
    });
}

/// Labels of tetrahedra may meet in ways that no later stage mends; none may make it worse.
void expect_as_many_violations(const test::ArrayMesh& mesh) {
    for (const auto& [cap, background] : {std::pair(true, std::vector<InputLabel>{}), {false, {}}, {true, {0}}}) {
        ReconstructOptions options = plain();
        options.cap = cap;
        options.background = background;
        const Reconstruction before = run(mesh, options);
        for (ReconstructOptions more :
             {reduced(0.9), ReconstructOptions{.decimate = false}, ReconstructOptions{.reduce = 0.9},
              ReconstructOptions{.reduce = 0.9, .preserve_volume = true}}) {
            more.cap = cap;
            more.background = background;
            const Reconstruction after = run(mesh, more);
            for (int kind = 0; kind < kViolationKindCount; ++kind)
                EXPECT_EQ(after.report.check.counts[kind], before.report.check.counts[kind])
                    << to_string(static_cast<ViolationKind>(kind));
        }
    }
}

TEST(TetrahedronFaces, noise_of_cells_gets_no_worse) {
    for (std::uint64_t seed : {1, 2})
        expect_as_many_violations(test::cell_mesh_of(test::noise_volume({7, 8, 9}, 3, seed)));
}

TEST(TetrahedronFaces, grains_of_cells_get_no_worse) {
    for (std::uint64_t seed : {1, 2}) {
        expect_as_many_violations(test::cell_mesh_of(test::grain_volume({12, 11, 13}, 8, seed)));
        expect_as_many_violations(by_cells(test::bent_mesh({12, 11, 13}, 8, seed)));
    }
}

TEST(TetrahedronFaces, a_mesh_that_touches_itself_gets_no_worse) {
    const test::Size size{7, 7, 7};
    const auto at_an_edge = [](auto x, auto y, auto) { return (x < 3) == (y < 3); };
    const auto at_a_node = [](auto x, auto y, auto z) { return (x < 3) == (y < 3) && (y < 3) == (z < 3); };
    for (const test::ArrayMesh& mesh :
         {test::mesh_of(test::solid_volume(size)), test::mesh_of(test::grain_volume(size, 5, 1)),
          test::cell_mesh_of(test::grain_volume(size, 5, 2))})
        for (const test::ArrayMesh& part : {carved(mesh, size, at_an_edge), carved(mesh, size, at_a_node)})
            expect_as_many_violations(part);
}

TEST(TetrahedronFaces, points_that_no_tetrahedron_has_do_not_matter) {
    const test::ArrayMesh mesh = test::bent_mesh({8, 9, 10}, 6, 4);
    LabelledPoints points = mesh.points();
    for (Vec3 p : {Vec3{-500, 3, 3}, Vec3{3, 1e6, 3}, Vec3{3.3, 3.3, 3.3}, Vec3{3, 3, 1e9}}) {
        points.positions.push_back(p);
        points.labels.push_back(0);
    }
    const test::ArrayMesh more{points, mesh.tetrahedra()};
    for (const ReconstructOptions& options : stages())
        EXPECT_EQ(surface_digest(run(more, options).mesh), surface_digest(run(mesh, options).mesh));
}

TEST(TetrahedronFaces, labels_that_only_unused_points_have_are_no_regions) {
    const test::ArrayMesh mesh = test::bent_mesh({8, 9, 10}, 3, 4);
    LabelledPoints points = mesh.points();
    points.positions.push_back({20, 20, 20});
    points.labels.push_back(77);
    const Reconstruction made = run({points, mesh.tetrahedra()}, reduced(0.5));
    expect_sound(made.report.check);
    EXPECT_FALSE(volumes_of(made).contains(77));
}

/// Its six-fold volume is not zero, but comes out so in plain arithmetic.
test::ArrayMesh thinner_than_numbers() {
    const double e = std::ldexp(1, -40);
    return {{{{0, 0, 0}, {1, 1 + e, 0}, {1 + e, 1 + 2 * e, 0}, {0, 0, 1}}, {1, 1, 1, 1}}, {{{0, 1, 2, 3}}}};
}

TEST(TetrahedronFaces, a_tetrahedron_thinner_than_numbers_is_refused) {
    EXPECT_THROW(run(thinner_than_numbers()), Error);
}

TEST(TetrahedronFaces, coordinates_whose_products_are_beyond_numbers_are_refused_or_sound) {
    for (double scale : {1e110, 1e160, 1e300, 1e-110, 1e-160, 1e-300}) {
        test::ArrayMesh mesh = test::bent_mesh({4, 4, 4}, 2, 1);
        LabelledPoints points = mesh.points();
        for (Vec3& p : points.positions) p = scale * p;
        for (const ReconstructOptions& options : stages()) {
            SCOPED_TRACE(std::to_string(scale));
            try {
                expect_sound(run({points, mesh.tetrahedra()}, options).report.check);
            } catch (const Error& error) {
                EXPECT_EQ(error.code(), ErrorCode::kInput);
            }
        }
    }
}

}  // namespace
}  // namespace regionmesh
