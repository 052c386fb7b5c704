#include "stream/plan.h"

#include <gtest/gtest.h>

#include "smooth/tuning.h"
#include "stream/face_source.h"

namespace regionmesh {
namespace {

/// Bytes of two strips of so many faces in the window of smoothing: sections have 100 x 100 samples, and two are held.
std::uint64_t window_of_two(std::uint64_t faces, SmoothFilter filter) {
    const std::uint32_t strips = 8;
    SourceShape shape;
    shape.lattice.size = {100, 100, strips + 1};
    shape.strip_count = strips;
    FaceCount counted{std::vector<std::uint64_t>(strips, faces), strips * faces, {}};
    ReconstructOptions options;
    options.smooth.filter = filter;
    options.strips_per_chunk = 1;
    options.memory = std::uint64_t{1} << 40;
    const Plan plan = make_plan(shape, std::move(counted), 2, options);
    return plan.budget.chunks.front().merged;
}

TEST(Plan, surfaces_with_many_faces_a_sample_take_more_in_the_lattice_window) {
    EXPECT_EQ(window_of_two(40000, SmoothFilter::kLattice), 2u * 40000 * smoothing::kLatticeBytesPerFace);
    EXPECT_EQ(window_of_two(40001, SmoothFilter::kLattice), 2u * 40001 * smoothing::kDenseLatticeBytesPerFace);
    EXPECT_EQ(window_of_two(40001, SmoothFilter::kTaubin), 40001u * window_of_two(1, SmoothFilter::kTaubin));
}

}  // namespace
}  // namespace regionmesh
