// Sections with z scaled: flat voxels are computed with as if they were nearly cubes.
#include <gmock/gmock.h>

#include "regionmesh/error.h"
#include "support/runs.h"

namespace regionmesh {
namespace {

constexpr double kFlat = 0.5;

test::ArrayVolume flat_volume(double spacing_z) {
    test::ArrayVolume volume = test::grain_volume({14, 13, 12}, 9, 20260719);
    volume.spaced({100, 100, spacing_z});
    volume.lattice().origin = {30, -20, 7 * spacing_z};
    return volume;
}

Reconstruction run_flat(double spacing_z, double scale_z) {
    test::ArrayVolume volume = flat_volume(spacing_z);
    return test::run(volume, {.reduce = 0.8, .scale_z = scale_z, .preserve_volume = true, .background = {}});
}

TEST(ScaleZ, flat_voxels_reach_the_target_and_keep_samples) {
    const Reconstruction plain = run_flat(kFlat, 1), scaled = run_flat(kFlat, 200);
    test::expect_sound(scaled.report.check);
    ASSERT_TRUE(scaled.report.samples);
    EXPECT_GT(scaled.report.samples->samples, 0u);
    EXPECT_LE(scaled.report.final_faces, scaled.report.initial_faces / 5);
    EXPECT_GT(plain.report.final_faces, scaled.report.final_faces);
}

TEST(ScaleZ, is_the_model_of_higher_voxels_made_flat_again) {
    const double factor = 256;  // the power of two nearest to 200
    const Reconstruction scaled = run_flat(kFlat, 200), high = run_flat(kFlat * factor, 1);
    ASSERT_EQ(scaled.mesh.face_count(), high.mesh.face_count());
    ASSERT_EQ(scaled.mesh.vertex_end(), high.mesh.vertex_end());
    for (std::uint32_t n = 0; n < high.mesh.vertex_end(); ++n) {
        const Vec3 a = scaled.mesh[VertexId{n}].position, b = high.mesh[VertexId{n}].position;
        EXPECT_EQ(a, (Vec3{b.x, b.y, b.z / factor}));
    }
    ASSERT_EQ(scaled.report.unsmoothed_volumes.size(), high.report.unsmoothed_volumes.size());
    for (std::size_t n = 0; n < high.report.unsmoothed_volumes.size(); ++n)
        EXPECT_DOUBLE_EQ(scaled.report.unsmoothed_volumes[n], high.report.unsmoothed_volumes[n] / factor);
}

TEST(ScaleZ, a_factor_that_leaves_the_range_of_lengths_is_refused) {
    for (const double factor : {-2.0, 1e300, 1e11, std::nan("")}) EXPECT_THROW(run_flat(kFlat, factor), Error);
}

TEST(ScaleZ, volumes_of_the_report_are_not_scaled) {
    test::ArrayVolume volume = test::grain_volume({12, 11, 10}, 5, 3);
    const Reconstruction made = test::run(volume, {.scale_z = 4, .decimate = false, .background = {}});
    for (const RegionReport& region : made.report.check.regions) {
        EXPECT_NEAR(made.report.smoothing.volume_after[region.label], region.volume, 1e-9 * region.volume);
        EXPECT_EQ(made.report.smoothing.volume_before[region.label], made.report.unsmoothed_volumes[region.label]);
    }
}

TEST(ShearedVolume, volumes_of_the_report_are_those_in_space) {
    test::ArrayVolume volume = test::grain_volume({12, 11, 10}, 5, 3);
    volume.lattice().direction = {1, 0.6, 0, 0, 0.8, 0.6, 0, 0, -0.8};
    const Reconstruction made = test::run(volume, {.scale_z = 4, .decimate = false, .background = {}});
    double unsmoothed = 0;
    for (const RegionReport& region : made.report.check.regions) {
        EXPECT_NEAR(made.report.smoothing.volume_after[region.label], region.volume, 1e-9 * region.volume);
        EXPECT_EQ(made.report.smoothing.volume_before[region.label], made.report.unsmoothed_volumes[region.label]);
        unsmoothed += made.report.unsmoothed_volumes[region.label];
    }
    EXPECT_NEAR(unsmoothed, 11 * 10 * 9 * 0.64, 1e-9);
}

}  // namespace
}  // namespace regionmesh
