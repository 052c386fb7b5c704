#include "regionmesh/process.h"

#include <gtest/gtest.h>

#include <cstring>
#include <memory>
#include <vector>

namespace regionmesh {
namespace {

#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

TEST(Process, freed_memory_is_kept_while_the_process_is_smaller_than_later) {
    constexpr std::size_t kBlock = 64 << 10, kBlocks = 1024;
    constexpr std::uint64_t kHalf = kBlock * kBlocks / 2;
    std::vector<std::unique_ptr<char[]>> blocks;
    for (std::size_t n = 0; n < kBlocks; ++n) {
        blocks.push_back(std::make_unique_for_overwrite<char[]>(kBlock));
        std::memset(blocks.back().get(), 1, kBlock);
    }
    const std::uint64_t held = resident_bytes().now;
    for (std::size_t n = 0; n + 1 < kBlocks; ++n) blocks[n].reset();  // the last one keeps the heap from shrinking
    note_memory_room(MemoryRoom::kSome, 2 * held);
    give_back_freed_memory();
    EXPECT_GT(resident_bytes().now, held - kHalf);
    note_memory_room(MemoryRoom::kSome, held - kHalf);
    EXPECT_LT(resident_bytes().now, held - kHalf);
    note_memory_room(MemoryRoom::kAmple);
}

#endif

}  // namespace
}  // namespace regionmesh
