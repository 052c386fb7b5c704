#include "stream/tile_stage.h"

#include <gtest/gtest.h>

#include "simplify/tiles/coarsen_caps.h"
#include "stream/section_faces.h"
#include "support/runs.h"

namespace regionmesh {
namespace {

/// Faces of each chunk before and after the first stage.
std::vector<std::pair<std::size_t, std::size_t>> faces_of_chunks(test::ArrayVolume volume, double reduce,
                                                                 std::uint32_t passes = 0) {
    ReconstructOptions options = test::reduced(reduce);
    options.smooth = {.filter = SmoothFilter::kTaubin, .passes = passes};
    Reconstruction result;
    const OnProgress on_progress;
    RunLog log(result, on_progress);
    SectionFaces source(volume, {.background = {}, .cells = options.cells});
    std::optional<FaceCount> counted = source.count({});
    const SourceShape& shape = source.shape();
    const Plan plan = make_plan(shape, std::move(counted), 0, options);
    Strips strips(source, options.smooth, strip_order(shape, 0), log);
    Gatherer gatherer(strips, plan.budget.chunk_strips, log);
    TileStage stage(plan, options, shape, log);
    std::vector<std::pair<std::size_t, std::size_t>> faces;
    for (GatheredStrips gathered; gatherer.next(gathered);) {
        const std::size_t before = gathered.chunk.faces.size();
        const Chunk left = stage.run(gathered);
        faces.emplace_back(before, left.faces.size());
    }
    return faces;
}

TEST(TileStage, ends_where_the_target_is_near_and_few_collapses_are_free) {
    const auto faces = faces_of_chunks(test::noise_volume({12, 12, 60}, 60, 7), 0.3, 2);
    ASSERT_GE(faces.size(), 3u);
    EXPECT_GT(faces[0].first, 1u << 16);
    EXPECT_LT(faces[0].second, faces[0].first) << "some are free";
    for (std::size_t n = 1; n < faces.size(); ++n) EXPECT_EQ(faces[n].second, faces[n].first);
}

TEST(TileStage, goes_on_where_the_target_ends_free_collapses) {
    const auto faces = faces_of_chunks(test::solid_volume({160, 160, 60}), 0.2);
    ASSERT_GE(faces.size(), 3u);
    EXPECT_GT(faces[0].first, 1u << 16);
    for (const auto& [before, after] : faces) EXPECT_LT(static_cast<double>(after), 0.85 * static_cast<double>(before));
}

TEST(TileStage, does_nothing_where_the_target_is_very_near) {
    for (const auto& [before, after] : faces_of_chunks(test::noise_volume({12, 12, 60}, 60, 7), 0.05))
        EXPECT_EQ(after, before);
}

TEST(TileStage, goes_on_where_a_farther_target_allows_more) {
    const auto faces = faces_of_chunks(test::noise_volume({12, 12, 60}, 60, 7), 0.5);
    for (const auto& [before, after] : faces) EXPECT_LT(after, before);
}

TEST(TileStage, coarsens_caps_only_where_the_target_removes_as_many_faces_as_all_caps_can_have) {
    SourceShape shape;
    shape.lattice.size = {61, 61, 61};
    shape.cells = CellKind::kCompact;
    const std::uint64_t caps = most_cap_faces(shape.lattice);
    const auto coarsens_to = [&](double share, std::optional<std::uint64_t> total) {
        return TileStage::may_coarsen_caps(shape, {.faces = {}, .reduce = 1 - share, .total = total});
    };
    EXPECT_TRUE(coarsens_to(0.4, 2 * caps));
    EXPECT_FALSE(coarsens_to(0.6, 2 * caps));
    EXPECT_FALSE(coarsens_to(0.1, caps));
    EXPECT_FALSE(coarsens_to(0.1, {})) << "the total is not known";
    const Target only_error;
    EXPECT_TRUE(TileStage::may_coarsen_caps(shape, only_error));
    shape.cells = CellKind::kTetrahedra;
    EXPECT_FALSE(TileStage::may_coarsen_caps(shape, only_error));
}

}  // namespace
}  // namespace regionmesh
