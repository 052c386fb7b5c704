#include "simplify/tiles/threshold_passes.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "simplify/tiles/mesh_chunk.h"
#include "support/digest.h"
#include "support/runs.h"

namespace regionmesh {
namespace {

/// The unsimplified model as one batch.
Chunk whole(test::ArrayVolume& volume) {
    Reconstruction made = test::run(volume);
    return take_chunk(made.mesh);
}
TilePlan plan_of(const test::ArrayVolume& volume) { return {volume.info().lattice, kSweepZ, 8, 8}; }
PassOptions to(std::uint64_t faces) {
    return {.target_faces = faces, .tile_faces = 1500, .tiles = {.threshold = 0, .keep_share = 0, .simplify = {}}};
}

TEST(ThresholdPasses, comes_near_the_goal_from_above_and_stays_sound) {
    test::ArrayVolume volume = test::grain_volume({40, 36, 30}, 20, 11);
    Chunk batch = whole(volume);
    const std::uint64_t faces = batch.faces.size();
    for (std::uint64_t goal : {faces / 2, faces / 5, faces / 9}) {
        const PassResult done = simplify_in_passes(batch, plan_of(volume), to(goal));
        EXPECT_GT(done.passes, 0u);
        EXPECT_GT(done.verdicts[static_cast<int>(Verdict::kAccepted)], 0u);
        EXPECT_GE(batch.faces.size(), goal);
        EXPECT_LE(batch.faces.size(), goal * 3 / 2);
        test::expect_sound(check(sorted_mesh_of(batch)));
    }
}

TEST(ThresholdPasses, gives_the_same_bytes_for_any_number_of_threads_and_of_tiles_in_flight) {
    test::ArrayVolume volume = test::grain_volume({40, 36, 30}, 20, 12);
    const Chunk before = whole(volume);
    const auto digest = [&](std::uint32_t threads, std::uint32_t in_flight) {
        Chunk batch = before;
        PassOptions options = to(before.faces.size() / 6);
        options.tiles.threads = threads;
        options.tiles.in_flight = in_flight;
        simplify_in_passes(batch, plan_of(volume), options);
        return test::digest(sorted_mesh_of(batch));
    };
    const std::uint64_t one = digest(1, 16);
    for (std::uint32_t threads : {2u, 3u, 8u})
        for (std::uint32_t in_flight : {1u, 3u, 16u}) EXPECT_EQ(digest(threads, in_flight), one);
}

TEST(ThresholdPasses, leaves_open_vertices_and_what_reaches_beyond_as_they_are) {
    test::ArrayVolume volume = test::grain_volume({40, 36, 30}, 20, 13);
    Chunk batch = whole(volume);
    constexpr double kHigh = 20.25;
    std::vector<Vec3> open;
    for (std::uint32_t v = 0; v < batch.vertices.size(); v += 97) batch.active.push_back(v);
    for (std::uint32_t v : batch.active) open.push_back(batch.vertices[v].position);
    const auto faces_beyond = [&] {
        std::size_t count = 0;
        for (const ChunkFace& face : batch.faces)
            count += std::any_of(face.vertices.begin(), face.vertices.end(),
                                 [&](std::uint32_t v) { return batch.vertices[v].position.z > kHigh; });
        return count;
    };
    const std::size_t beyond = faces_beyond(), before = batch.faces.size();
    PassOptions options = to(before / 2);
    options.safe.high = kHigh;
    simplify_in_passes(batch, plan_of(volume), options);
    EXPECT_LT(batch.faces.size(), before * 3 / 4);
    EXPECT_EQ(faces_beyond(), beyond);
    ASSERT_EQ(batch.active.size(), open.size());
    for (std::size_t n = 0; n < open.size(); ++n) EXPECT_EQ(batch.vertices[batch.active[n]].position, open[n]);
    test::expect_sound(check(sorted_mesh_of(batch)));
}

TEST(ThresholdPasses, leaves_small_models_and_those_near_the_goal_to_the_heap) {
    test::ArrayVolume volume = test::grain_volume({20, 20, 20}, 10, 14);
    Chunk batch = whole(volume);
    const std::size_t faces = batch.faces.size();
    EXPECT_EQ(simplify_in_passes(batch, plan_of(volume), to(faces * 97 / 100)).passes, 0u);
    EXPECT_FALSE(is_worth_pass(faces, to(faces * 97 / 100)));
    EXPECT_TRUE(is_worth_pass(faces, to(faces / 10)));
    PassOptions large = to(faces / 10);
    large.tile_faces = static_cast<std::uint32_t>(faces);
    EXPECT_EQ(simplify_in_passes(batch, plan_of(volume), large).passes, 0u);
    EXPECT_FALSE(is_worth_pass(faces, large));
    EXPECT_EQ(batch.faces.size(), faces);
}

TEST(ThresholdPasses, stops_at_the_largest_error_where_there_is_no_goal) {
    test::ArrayVolume volume = test::grain_volume({40, 36, 30}, 20, 15);
    Chunk batch = whole(volume);
    const std::size_t faces = batch.faces.size();
    PassOptions options = to(0);
    options.tiles.simplify.promises.max_error = 0.1;
    simplify_in_passes(batch, plan_of(volume), options);
    EXPECT_LT(batch.faces.size(), faces / 2);
    EXPECT_GT(batch.faces.size(), faces / 20);
    test::expect_sound(check(sorted_mesh_of(batch)));
}

TEST(Determinism, a_budget_kept_in_boxes_gives_the_same_bytes_for_any_number_of_threads) {
    test::ArrayVolume volume = test::grain_volume({64, 64, 64}, 300, 16);
    ReconstructOptions options = test::reduced(0.95);
    options.face_budget = 75'000;
    options.threads = 1;
    const Reconstruction one = test::run(volume, options);
    test::expect_sound(one.report.check);
    EXPECT_LT(one.report.peak_faces, 90'000u) << "a run may bring more than the one before";
    EXPECT_EQ(one.report.stopped, StopReason::kTarget);
    for (std::uint32_t threads : {3u, 8u}) {
        options.threads = threads;
        EXPECT_EQ(test::digest(test::run(volume, options).mesh), test::digest(one.mesh));
    }
}

}  // namespace
}  // namespace regionmesh
