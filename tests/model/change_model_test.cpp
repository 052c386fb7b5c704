#include "regionmesh/change_model.h"

#include <gtest/gtest.h>

#include <set>

#include "regionmesh/write_report.h"
#include "support/runs.h"
#include "support/volumes.h"

namespace regionmesh {
namespace {

Reconstruction blocky(test::ArrayVolume volume, bool cap = true) {
    ReconstructOptions options{.smooth = {.passes = 0}, .decimate = false, .background = {}};
    options.cap = cap;
    return test::run(std::move(volume), options);
}

Settings settings_of(const OptionValues& values) {
    Settings settings;
    apply_options(settings, values);
    return settings;
}

std::uint64_t fixed_vertices(const Mesh& mesh) {
    std::uint64_t count = 0;
    test::for_vertices(mesh, [&](VertexId v) { count += mesh[v].is_fixed; });
    return count;
}

TEST(ChangeModel, simplifies_improves_and_reports_what_it_did) {
    Reconstruction made = blocky(test::grain_volume({14, 12, 13}, 5, 3));
    const std::uint32_t faces = made.mesh.face_count();
    std::set<std::string> stages;
    const ModelChange change =
        simplify_model(made.mesh, settings_of({{"reduce", "70%"}, {"smooth-lines", "true"}, {"improve", "true"}}), {},
                       {}, {}, [&](const char* stage, auto, const auto&) { stages.insert(stage); });
    const Report& report = change.report;
    EXPECT_EQ(report.initial_faces, faces);
    EXPECT_EQ(report.peak_faces, faces);
    EXPECT_EQ(report.final_faces, made.mesh.face_count());
    EXPECT_LT(report.final_faces, faces / 3);
    EXPECT_EQ(report.stopped, StopReason::kTarget);
    EXPECT_TRUE(report.improved);
    EXPECT_GT(report.smoothed_lines.value().moves, 0u);
    EXPECT_EQ(report.seconds.count("decimate") + report.seconds.count("improve"), 2u);
    EXPECT_EQ(report.check.violation_count() + change.before.violation_count() + change.locked.vertices, 0u);
    EXPECT_TRUE(stages.contains("improve") && stages.contains("smooth lines") && stages.contains("check"));
}

TEST(ChangeModel, the_bound_on_quality_is_that_of_the_spacing_where_it_is_known) {
    const auto bound = [](OptionValues options, const std::optional<Vec3>& spacing) {
        Reconstruction made = blocky(test::grain_volume({9, 9, 9}, 3, 3));
        options.emplace_back("reduce", "20%");
        return simplify_model(made.mesh, settings_of(options), {}, spacing).report.quality_bound;
    };
    EXPECT_EQ(bound({}, {}), 0.1);
    EXPECT_EQ(bound({}, Vec3{2, 4, 20}), 0.01);
    EXPECT_EQ(bound({{"min-quality", "0.05"}}, Vec3{2, 4, 20}), 0.05);
    EXPECT_EQ(bound({{"improve", "true"}}, Vec3{2, 4, 20}), 0.1);
}

TEST(ChangeModel, what_has_violations_stays_and_is_not_fixed_afterwards) {
    Reconstruction made = blocky(test::grain_volume({14, 12, 13}, 5, 3));
    made.mesh.remove_face(FaceId{made.mesh.face_end() / 2});
    const ModelChange change = simplify_model(made.mesh, settings_of({{"reduce", "50%"}}), {});
    EXPECT_GT(change.before.violation_count(), 0u);
    EXPECT_GT(change.locked.vertices, 0u);
    EXPECT_EQ(change.report.check.violation_count(), change.before.violation_count());
    EXPECT_EQ(fixed_vertices(made.mesh), 0u);
}

TEST(ChangeModel, open_models_are_smoothed_inside_their_rims) {
    Reconstruction made = blocky(test::grain_volume({14, 12, 13}, 5, 3), false);
    const Box before = size_of(made.mesh).box;
    const ModelChange change = smooth_model(made.mesh, settings_of({{"smooth", "10"}}), {.boundary_is_open = true});
    EXPECT_GT(change.report.smoothing.largest_displacement, 0.1);
    EXPECT_EQ(change.report.stopped, StopReason::kNoneAsked);
    EXPECT_EQ(change.report.check.violation_count(), 0u);
    EXPECT_EQ(size_of(made.mesh).box.low, before.low);
    EXPECT_EQ(size_of(made.mesh).box.high, before.high);
}

TEST(ChangeModel, volumes_of_sheared_models_are_those_in_space) {
    test::ArrayVolume volume = test::grain_volume({14, 12, 13}, 5, 3);
    volume.lattice().direction = {1, 0.6, 0, 0, 0.8, 0.6, 0, 0, 0.8};
    Reconstruction made = blocky(std::move(volume));
    const CheckReport before = check(made.mesh);
    const ModelChange change =
        smooth_model(made.mesh, settings_of({{"smooth", "10"}, {"preserve-volume", "true"}}), {});
    for (const RegionReport& region : before.regions)
        EXPECT_NEAR(change.report.unsmoothed_volumes.at(region.label), region.volume, 1e-9 * region.volume);
    for (const RegionReport& region : change.report.check.regions)
        EXPECT_NEAR(region.volume, change.report.unsmoothed_volumes.at(region.label), 2e-6 * region.volume);
}

}  // namespace
}  // namespace regionmesh
