#include "simplify/tiles/tiles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>
#include <vector>

#include "cells/label_census.h"
#include "cells/strip_mesher.h"
#include "simplify/tiles/simplify_tiles.h"
#include "smooth/smoother.h"
#include "stream/merger.h"
#include "support/digest.h"
#include "support/runs.h"
#include "volume/section_window.h"

namespace regionmesh {
namespace {

/// The whole volume as one batch, with what its labels say.
struct Batch {
    explicit Batch(test::ArrayVolume& volume, const SmoothOptions& smooth = {.passes = 0})
        : lattice(volume.info().lattice) {
        volume.rewind();
        LabelTable labels;
        std::optional<Smoother> smoothing;
        if (smooth.passes > 0) smoothing.emplace(smooth, ChunkOrder{.axis = 2, .thickness = lattice.spacing.z});
        SectionWindow window(volume, labels);
        StripMesher mesher(lattice, kSweepZ, {});
        LabelCensus census(lattice, kSweepZ, {});
        while (window.advance()) {
            Chunk strip;
            census.add(window.low(), window.high(), window.is_last());
            mesher.mesh(window.low(), window.high(), strip);
            if (!smoothing) {
                whole.append(strip);
                continue;
            }
            EXPECT_TRUE(smoothing->add(strip, window.is_last(), window.sections_read() - 1));
            while (smoothing->next(strip)) whole.append(strip);
        }
        oracle = census.oracle();
    }
    Mesh mesh() const {
        Merger merger;
        merger.add(whole);
        return merger.take_mesh();
    }

    Lattice lattice;
    Chunk whole;
    LabelOracle oracle;
};

/// Tiles of so many cells, one chunk for all sections.
TilePlan plan_of(const Batch& batch, std::uint32_t cells) {
    return {batch.lattice, kSweepZ, batch.lattice.size[2], cells};
}

/// One chunk of all sections: nothing comes before or after.
SafeInterval extent_of(const Batch& batch) { return {0, (batch.lattice.size[2] - 1) * batch.lattice.spacing.z}; }

/// In tiles of so many cells.
VerdictCounts simplify(Batch& batch, std::uint32_t cells, const TileOptions& options) {
    TileResult done = simplify_chunk(batch.whole, {}, extent_of(batch), plan_of(batch, cells), options);
    batch.whole = std::move(done.left);
    return done.verdicts;
}

TEST(Chunk, appended_strips_make_the_model_of_strips_welded_one_by_one) {
    test::ArrayVolume volume = test::noise_volume({6, 5, 7}, 4, 1);
    const Batch batch(volume);
    EXPECT_TRUE(batch.whole.active.empty());
    EXPECT_EQ(test::surface_digest(batch.mesh()), test::surface_digest(test::run(volume).mesh));
}

TEST(Tiles, remove_faces_and_keep_what_the_labels_say) {
    test::ArrayVolume volume = test::grain_volume({33, 26, 9}, 9, 3);
    Batch batch(volume);
    const std::size_t faces = batch.whole.faces.size();
    const VerdictCounts verdicts =
        simplify(batch, 8, {.threshold = 1e-3, .keep_share = 0, .threads = 1, .simplify = {}});
    EXPECT_LT(batch.whole.faces.size(), faces * 7 / 10);
    EXPECT_GT(verdicts[static_cast<int>(Verdict::kAccepted)], 0u);
    CheckOptions options;
    options.oracle = batch.oracle;
    test::expect_sound(check(batch.mesh(), options));
}

TEST(Tiles, stay_in_their_boxes) {
    test::ArrayVolume volume = test::ball_volume({21, 21, 21}, 7);
    Batch batch(volume);
    Mesh before = batch.mesh();
    simplify(batch, 5, {.threshold = 1, .keep_share = 0, .threads = 1, .simplify = {}});
    // A face that reaches across x = 5, 10, 15 would lie in two tiles.
    for (const ChunkFace& face : batch.whole.faces)
        for (double wall : {5.0, 10.0, 15.0}) {
            int below = 0, above = 0;
            for (std::uint32_t v : face.vertices) {
                below += batch.whole.vertices[v].position.x < wall;
                above += batch.whole.vertices[v].position.x > wall;
            }
            EXPECT_TRUE(below == 0 || above == 0);
        }
    EXPECT_LT(batch.whole.faces.size(), before.face_count());
}

TEST(Tiles, leave_faces_that_reach_out_of_them_and_do_not_run_into_them) {
    test::ArrayVolume volume = test::grain_volume({31, 30, 12}, 40, 8);
    for (SmoothFilter filter : {SmoothFilter::kTaubin, SmoothFilter::kLaplacian}) {
        Batch batch(volume, {.filter = filter, .passes = 30});
        std::size_t reaching = 0;
        for (const ChunkFace& face : batch.whole.faces) {
            double low = HUGE_VAL, high = -HUGE_VAL;
            for (std::uint32_t v : face.vertices) {
                low = std::min(low, batch.whole.vertices[v].position.x);
                high = std::max(high, batch.whole.vertices[v].position.x);
            }
            for (double wall : {6.0, 12.0, 18.0, 24.0}) reaching += low < wall && high > wall;
        }
        EXPECT_GT(reaching, 100u) << "this test needs faces across walls";
        const std::size_t faces = batch.whole.faces.size();
        simplify(batch, 6, {.threshold = 1, .keep_share = 0, .threads = 1, .simplify = {}});
        EXPECT_LT(batch.whole.faces.size(), faces * 9 / 10);
        CheckOptions options;
        options.oracle = batch.oracle;
        test::expect_sound(check(batch.mesh(), options));
    }
}

TEST(Tiles, keep_the_share_they_are_told_to) {
    test::ArrayVolume volume = test::solid_volume({17, 17, 5});
    Batch batch(volume);
    const std::size_t faces = batch.whole.faces.size();
    simplify(batch, 8, {.threshold = 1e-3, .keep_share = 0.5, .threads = 1, .simplify = {}});
    EXPECT_GE(batch.whole.faces.size(), faces / 2 - 16);
    EXPECT_LE(batch.whole.faces.size(), faces / 2 + 16);
}

/// Noise in a row of tiles, nothing elsewhere.
Batch crowded() {
    std::vector<InputLabel> labels;
    const test::ArrayVolume noise = test::noise_volume({24, 6, 6}, 4, 3);
    for (std::uint32_t z = 0; z < 6; ++z)
        for (std::uint32_t y = 0; y < 24; ++y)
            for (std::uint32_t x = 0; x < 24; ++x) labels.push_back(y < 6 ? noise.labels()[(z * 6 + y) * 24 + x] : 1);
    test::ArrayVolume volume({24, 24, 6}, labels);
    return Batch(volume);
}

TEST(Tiles, in_flight_hold_no_more_faces_than_they_may) {
    const Batch batch = crowded();
    const TileGrid grid{.origin = batch.lattice.origin,
                        .spacing = batch.lattice.spacing,
                        .size = {23, 23, 5},
                        .cells = {6, 6, 5},
                        .is_bounded = true};
    const TiledFaces faces(batch.whole, {}, grid, 1);
    std::vector<std::uint32_t> tiles(grid.tile_count());
    std::iota(tiles.begin(), tiles.end(), 0);
    const auto most_in = [&](std::size_t count) {
        std::size_t most = 0;
        for (std::size_t first = 0; first + count <= tiles.size(); ++first) {
            std::size_t sum = 0;
            for (std::size_t n = first; n < first + count; ++n)
                sum += faces.faces_of(tiles[n]).size() + faces.halo_of(tiles[n]).size();
            most = std::max(most, sum);
        }
        return most;
    };
    ASSERT_GT(most_in(4), 2 * batch.whole.faces.size() / 3) << "this test needs tiles that hold most of the faces";
    for (std::uint32_t count : {1u, 2u, 3u, 4u, 7u}) {
        const TileOptions options{
            .threshold = 1, .keep_share = 0, .in_flight = 7, .faces_in_flight = most_in(count), .simplify = {}};
        const std::uint32_t found = tiles_in_flight(faces, tiles, options);
        EXPECT_GE(found, count);
        EXPECT_EQ(most_in(found), most_in(count));
    }
    EXPECT_EQ(tiles_in_flight(faces, tiles, {.threshold = 1, .keep_share = 0, .faces_in_flight = 0, .simplify = {}}),
              1u);
}

TEST(Tiles, in_flight_do_not_change_the_result) {
    std::set<std::uint64_t> digests;
    for (std::uint64_t most : {std::uint64_t{0}, std::uint64_t{9000}, kMostFaces})
        for (std::uint32_t threads : {1u, 2u}) {
            Batch batch = crowded();
            simplify(batch, 6,
                     {.threshold = 1, .keep_share = 0.3, .threads = threads, .faces_in_flight = most, .simplify = {}});
            digests.insert(test::digest(batch.mesh()));
        }
    EXPECT_EQ(digests.size(), 1u);
}

struct Grains {
    test::ArrayVolume volume = test::grain_volume({40, 36, 30}, 12, 7);
    const Batch batch{volume};

    /// Tiles of so many cells; the outermost end where the volume does.
    TileGrid grid(std::array<std::uint32_t, 3> cells) const {
        return {.origin = batch.lattice.origin,
                .spacing = batch.lattice.spacing,
                .size = {39, 35, 29},
                .cells = cells,
                .is_bounded = true};
    }
};

TEST(Tiles, trial_says_what_each_threshold_leaves) {
    const Grains grains;
    const Batch& batch = grains.batch;
    const TileGrid grid = grains.grid({20, 18, 15});
    std::vector<std::uint32_t> tiles(grid.tile_count());
    std::iota(tiles.begin(), tiles.end(), 0);
    const std::vector<double> thresholds{1e-3, 1e-2, 0.1, 1, 10};
    TiledFaces tried(batch.whole, {}, grid, 1);
    const std::vector<TileCounts> counts =
        try_thresholds(tried, tiles, {.threshold = 0, .keep_share = 0, .threads = 1, .simplify = {}}, thresholds);
    for (std::size_t n = 0; n < thresholds.size(); ++n) {
        SCOPED_TRACE(thresholds[n]);
        TiledFaces faces(batch.whole, {}, grid, 1);
        const auto left = static_cast<double>(
            simplify_tiles(faces, {.threshold = thresholds[n], .keep_share = 0, .threads = 1, .simplify = {}})
                .left.faces.size());
        EXPECT_EQ(counts[n].faces, batch.whole.faces.size());
        EXPECT_NEAR(static_cast<double>(counts[n].left_faces) / left, 1, 0.05);
        if (n > 0) {
            EXPECT_LT(counts[n].left_faces, counts[n - 1].left_faces);
        }
    }
}

TEST(Tiles, that_go_first_say_how_the_others_go_on) {
    const Grains grains;
    const Batch& batch = grains.batch;
    const TileGrid grid = grains.grid({10, 10, 10});
    const auto with = [](double threshold) {
        return TileOptions{.threshold = threshold, .keep_share = 0, .threads = 1, .simplify = {}};
    };
    TiledFaces all(batch.whole, {}, grid, 1);
    const std::size_t low = simplify_tiles(all, with(1e-3)).left.faces.size();
    TiledFaces all_high(batch.whole, {}, grid, 1);
    const std::size_t high = simplify_tiles(all_high, with(1)).left.faces.size();
    for (const double next : {1e-3, 1.0}) {
        std::uint64_t held = 0, left = 0;
        TiledFaces faces(batch.whole, {}, grid, 1);
        TileOptions options = with(1e-3);
        std::vector<double> shares;
        options.on_share = [&](double share) { shares.push_back(share); };
        const TileResult done = simplify_tiles_in_parts(faces, options, [&](std::uint64_t of, std::uint64_t kept) {
            held = of;
            left = kept;
            TileOptions own = options;
            own.threshold = next;
            return own;
        });
        EXPECT_GT(held, batch.whole.faces.size() / 20);
        EXPECT_LT(held, batch.whole.faces.size() / 2);
        EXPECT_LT(left, held);
        EXPECT_TRUE(std::ranges::is_sorted(shares));
        EXPECT_EQ(shares.back(), 1);
        if (next == 1) {
            EXPECT_LT(done.left.faces.size(), low);
            EXPECT_GT(done.left.faces.size(), high);
        } else {
            EXPECT_EQ(done.left.faces.size(), low);
        }
    }
}

TEST(Tiles, leave_carried_and_active_vertices_as_they_are) {
    test::ArrayVolume volume = test::grain_volume({12, 12, 7}, 4, 5);
    LabelTable labels;
    SectionWindow window(volume, labels);
    StripMesher mesher(volume.info().lattice, kSweepZ, {});
    Merger merger;
    Chunk chunk;
    std::vector<ChunkVertex> carried;
    const TilePlan plan{volume.info().lattice, kSweepZ, 3, 8};
    for (std::uint32_t strip = 0; window.advance(); ++strip) {
        Chunk next;
        mesher.mesh(window.low(), window.high(), next);
        chunk.append(next);
        if (strip % 3 != 2) continue;
        std::vector<ChunkVertex> active;
        for (std::uint32_t v : chunk.active)
            active.push_back(v < chunk.carried ? carried[v] : chunk.vertices[v - chunk.carried]);
        chunk = simplify_chunk(chunk, carried, {strip - 2.0, strip + 1.0}, plan,
                               {.threshold = 1e-2, .keep_share = 0, .threads = 1, .simplify = {}})
                    .left;
        ASSERT_EQ(chunk.active.size(), active.size());
        for (std::size_t n = 0; n < active.size(); ++n) {
            const std::uint32_t v = chunk.active[n];
            const ChunkVertex& left = v < chunk.carried ? carried[v] : chunk.vertices[v - chunk.carried];
            EXPECT_EQ(left.position, active[n].position);
        }
        merger.add(chunk);
        carried = std::move(active);
        chunk.clear();
    }
    test::expect_sound(check(merger.take_mesh()));
}

TEST(Determinism, any_number_of_threads_gives_the_same_bytes) {
    test::ArrayVolume volume = test::grain_volume({70, 40, 36}, 30, 11);
    ReconstructOptions options = test::reduced(0.9);
    options.threads = 1;
    const std::uint64_t one = test::digest(test::run(volume, options).mesh);
    for (std::uint32_t threads : {2u, 3u, 8u, 0u}) {
        options.threads = threads;
        EXPECT_EQ(test::digest(test::run(volume, options).mesh), one);
    }
}

TEST(TilePlan, comes_from_the_size_alone) {
    Lattice lattice;
    lattice.size = {360, 360, 100};
    EXPECT_EQ(plan_tiles(lattice, kSweepZ).chunk_strips, 16u);
    lattice.size = {64, 64, 64};
    EXPECT_EQ(plan_tiles(lattice, kSweepZ).chunk_strips, 24u);
    lattice.size = {5000, 5000, 64};
    EXPECT_EQ(plan_tiles(lattice, kSweepZ).chunk_strips, 8u);
    EXPECT_EQ(plan_tiles(lattice, kSweepZ).tile_cells, 24u);
}

TEST(TilePlan, tiles_of_thin_volumes_are_wider) {
    Lattice lattice;
    lattice.size = {5, 1303, 1740};
    EXPECT_EQ(plan_tiles(lattice, kSweepZ).chunk_strips, 58u);
    EXPECT_EQ(plan_tiles(lattice, kSweepZ).tile_cells, 58u);
    lattice.size = {5, 1303, 321};  // at least eight runs
    EXPECT_EQ(plan_tiles(lattice, kSweepZ).chunk_strips, 40u);
    lattice.size = {201, 3, 900};  // at least eight tiles
    EXPECT_EQ(plan_tiles(lattice, kSweepZ).tile_cells, 25u);
    lattice.size = {3, 20, 900};
    EXPECT_EQ(plan_tiles(lattice, kSweepZ).tile_cells, 24u);
    lattice.size = {1, 900, 900};
    EXPECT_EQ(plan_tiles(lattice, kSweepZ).tile_cells, 112u);
}

}  // namespace
}  // namespace regionmesh
