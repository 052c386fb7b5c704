#include "blocks/block_size.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "regionmesh/error.h"
#include "stream/section_faces.h"

namespace regionmesh {
namespace {

VolumeInfo cube(std::uint32_t samples) {
    VolumeInfo info;
    info.source = "cube";
    info.lattice.size = {samples, samples, samples};
    return info;
}

std::uint32_t cells_for(std::uint32_t samples, std::uint64_t memory) {
    ReconstructOptions options;
    options.smooth.filter = SmoothFilter::kLattice;
    options.memory = memory;
    const SourceShape shape = section_shape(cube(samples), CellKind::kCompact, 1);
    return default_block_cells(shape, std::uint64_t{samples} * samples * samples / 2, options);
}

TEST(BlockSize, grows_with_memory_up_to_the_whole_volume) {
    constexpr std::uint64_t kMiB = 1 << 20;
    std::uint32_t before = 0;
    for (const std::uint64_t memory : {1 * kMiB, 256 * kMiB, 1024 * kMiB, 8192 * kMiB}) {
        const std::uint32_t cells = cells_for(1025, memory);
        EXPECT_GE(cells, before);
        EXPECT_GE(cells, 60u) << "smaller blocks would be nearly all rim";
        before = cells;
    }
    EXPECT_LT(cells_for(1025, 256 * kMiB), cells_for(1025, 4096 * kMiB));
    EXPECT_EQ(cells_for(129, 4096 * kMiB), 128u);
}

TEST(BlockSize, needs_room_for_one_block) {
    constexpr std::uint64_t kMiB = 1 << 20, kFaces = std::uint64_t{257} * 257 * 257 / 2;
    ReconstructOptions options;
    options.smooth.filter = SmoothFilter::kLattice;
    const SourceShape shape = section_shape(cube(257), CellKind::kCompact, 1);
    options.memory = 4096 * kMiB;
    EXPECT_NO_THROW(require_block_memory("cube", shape, kFaces, 128, options));
    options.memory = 64 * kMiB;
    EXPECT_THROW(require_block_memory("cube", shape, kFaces, 128, options), Error);
    EXPECT_NO_THROW(require_block_memory("cube", shape, kFaces, 8, options));
}

TEST(PlanSweeps, take_each_block_once_as_many_as_memory_holds_and_some_for_each_process) {
    constexpr std::uint64_t kMiB = 1 << 20;
    ReconstructOptions options;
    options.smooth.filter = SmoothFilter::kLattice;
    const SourceShape shape = section_shape(cube(1025), CellKind::kCompact, 1);
    const BlockGrid grid(shape.lattice, 128);
    const auto plan = [&](std::uint64_t memory, std::uint32_t processes) {
        options.memory = memory;
        return plan_sweeps(grid, shape, std::uint64_t{1025} * 1025 * 1025 / 2, options, processes);
    };
    EXPECT_EQ(plan(64 * 1024 * kMiB, 1).size(), 1u);
    EXPECT_EQ(plan(1 * kMiB, 1).size(), 64u) << "columns of one block along the sweep";
    std::size_t before = 64;
    for (const std::uint64_t memory : {512 * kMiB, 2048 * kMiB, 8192 * kMiB}) {
        const std::size_t count = plan(memory, 1).size();
        EXPECT_LE(count, before);
        before = count;
    }
    for (const std::uint32_t processes : {1u, 2u, 7u, 100u, 10'000u})
        for (const std::uint64_t memory : {1 * kMiB, 1024 * kMiB, 64 * 1024 * kMiB}) {
            std::vector<int> taken(grid.count());
            const std::vector<IndexBox> sweeps = plan(memory, processes);
            for (const IndexBox& sweep : sweeps) grid.for_blocks(sweep, [&](std::uint32_t block) { ++taken[block]; });
            EXPECT_TRUE(std::ranges::all_of(taken, [](int times) { return times == 1; }));
            EXPECT_GE(sweeps.size(), processes == 1 ? 1 : std::min(grid.count(), 3 * processes));
        }
}

TEST(BlockSize, too_many_blocks_are_refused) {
    EXPECT_NO_THROW(require_block_count(cube(1025), 64));
    EXPECT_THROW(require_block_count(cube(100'000), 64), Error);
}

}  // namespace
}  // namespace regionmesh
