// What holds of every smoothed model, on volumes drawn at random.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "regionmesh/voxelise.h"
#include "support/runs.h"
#include "support/volumes_drawn.h"

namespace regionmesh {
namespace {

ReconstructOptions smoothed(double spacing_z, bool has_target) {
    ReconstructOptions options{.background = {}};
    options.smooth.passes = spacing_z > 1 ? 10 : 20;
    if (has_target) options.reduce = 0.7;
    return options;
}

RC_GTEST_PROP(SmoothProperties, models_are_sound_and_keep_samples, ()) {
    test::ArrayVolume volume = *test::drawn_volume(5);
    const double spacing_z = *rc::gen::element(1.0, 2.5, 7.0);
    const bool has_target = *rc::gen::arbitrary<bool>();
    volume.spaced({1, 1, spacing_z});
    const Reconstruction made = test::run(volume, smoothed(spacing_z, has_target));
    for (const Violation& violation : made.report.check.violations) RC_LOG() << violation.text << "\n";
    RC_ASSERT(made.report.check.violation_count() == 0u);
    RC_ASSERT(made.report.samples.has_value());
    RC_ASSERT(made.report.samples->wrong == 0u);
}

RC_GTEST_PROP(SmoothProperties, threads_do_not_change_the_result, ()) {
    test::ArrayVolume volume = *test::drawn_volume(5);
    ReconstructOptions one = smoothed(1, true), four = one;
    one.threads = 1;
    four.threads = 4;
    const Reconstruction a = test::run(volume, one), b = test::run(volume, four);
    RC_ASSERT(a.mesh.vertex_end() == b.mesh.vertex_end());
    for (std::uint32_t v = 0; v < a.mesh.vertex_end(); ++v)
        RC_ASSERT(a.mesh.position(VertexId{v}) == b.mesh.position(VertexId{v}));
}

}  // namespace
}  // namespace regionmesh
