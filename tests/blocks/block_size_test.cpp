#include "blocks/block_size.h"

#include <gtest/gtest.h>

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

TEST(BlockSize, too_many_blocks_are_refused) {
    EXPECT_NO_THROW(require_block_count(cube(1025), 64));
    EXPECT_THROW(require_block_count(cube(100'000), 64), Error);
}

}  // namespace
}  // namespace regionmesh
