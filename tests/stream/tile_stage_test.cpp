#include "stream/tile_stage.h"

#include <gtest/gtest.h>

#include "simplify/coarsen_caps.h"
#include "stream/section_faces.h"
#include "support/runs.h"

namespace regionmesh {
namespace {

/// Faces of each chunk before and after the first stage.
std::vector<std::pair<std::size_t, std::size_t>> faces_of_chunks(test::ArrayVolume volume, double reduce) {
    const ReconstructOptions options = test::reduced(reduce);
    Reconstruction result;
    const OnProgress on_progress;
    RunLog log(result, on_progress);
    SectionFaces source(volume, {.background = {}, .cells = options.cells});
    std::optional<FaceCount> counted = source.count();
    const SourceShape& shape = source.shape();
    const Plan plan = make_plan(shape, std::move(counted), 0, options);
    Strips strips(source, {.passes = 0}, strip_order(shape, 0), log);
    Gatherer gatherer(strips, plan.budget.chunk_strips, log);
    TileStage stage(plan, options, shape, log);
    std::vector<std::pair<std::size_t, std::size_t>> faces;
    for (GatheredStrips gathered; gatherer.next(gathered);) {
        const std::size_t before = gathered.chunk.faces.size();
        stage.run(gathered);
        faces.emplace_back(before, gathered.chunk.faces.size());
    }
    return faces;
}

TEST(TileStage, ends_where_a_near_target_allows_free_collapses_only_and_few_are_free) {
    const auto faces = faces_of_chunks(test::noise_volume({12, 12, 60}, 60, 7), 0.05);
    ASSERT_GE(faces.size(), 3u);
    EXPECT_GT(faces[0].first, 1u << 16);
    EXPECT_LT(faces[0].second, faces[0].first) << "some are free";
    for (std::size_t n = 1; n < faces.size(); ++n) EXPECT_EQ(faces[n].second, faces[n].first);
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
