#include "regionmesh/process.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#ifdef __GLIBC__
#include <malloc.h>
#endif
#if __has_include(<sys/mman.h>)
#include <sys/mman.h>
#endif

#include "regionmesh/huge_pages.h"

namespace regionmesh {
namespace {

/// What memory is spent on to have fewer page faults. Chosen for the AAL atlas to a tenth (docs/explanation/memory.md,
/// "Page faults").
struct Spending {
    std::size_t least_huge;    // bytes of a block on huge pages, which have 2 MiB
    std::uint64_t parts_kept;  // freed memory is given back where the process became larger by one part in so many
    int kept_end;              // free bytes at the end of a heap that the C library keeps
};
constexpr std::array kSpending{
    Spending{SIZE_MAX, UINT64_MAX, 128 << 10},    // MemoryRoom::kShort
    Spending{std::size_t{8} << 20, 24, 1 << 20},  // kSome
    Spending{std::size_t{3} << 20, 8, 64 << 20},  // kAmple
};

std::atomic<MemoryRoom> room{MemoryRoom::kAmple};
std::atomic<bool> may_set_heap{false};     // only programs do
std::atomic<std::uint64_t> held_later{0};  // bytes that the process will hold at some time in any case
std::atomic<std::uint64_t> most_left{0};   // resident after freed memory was given back in this room

const Spending& spending() { return kSpending[static_cast<std::size_t>(room.load())]; }

void give_back() {
#ifdef __GLIBC__
    malloc_trim(0);
    most_left = std::max(most_left.load(), resident_bytes().now);
#endif
}

void set_heap() {
#ifdef __GLIBC__
    if (may_set_heap) mallopt(M_TRIM_THRESHOLD, spending().kept_end);
#endif
}

}  // namespace

void note_memory_room(MemoryRoom now, std::uint64_t later) {
    room = now;
    held_later = later;
    set_heap();
    most_left = 0;
    give_back_freed_memory();
}

void prefer_huge_pages([[maybe_unused]] void* block, [[maybe_unused]] std::size_t bytes) {
#ifdef MADV_HUGEPAGE
    if (bytes < spending().least_huge) return;
    // Whole pages, and with them all of a mapping: realloc() moves a mapping of one kind only.
    constexpr std::uintptr_t kPage = 4096;
    const auto first = reinterpret_cast<std::uintptr_t>(block) / kPage * kPage;
    const auto end = (reinterpret_cast<std::uintptr_t>(block) + bytes + kPage - 1) / kPage * kPage;
    madvise(reinterpret_cast<void*>(first), end - first, MADV_HUGEPAGE);
#endif
}

void give_back_freed_memory() {
    const std::uint64_t before = most_left, grown = before + before / spending().parts_kept;
    if (room == MemoryRoom::kShort || resident_bytes().now >= std::max(grown, held_later.load())) give_back();
}

void keep_large_arrays_apart() {
#ifdef __GLIBC__
    mallopt(M_MMAP_THRESHOLD, 1 << 20);
#endif
    may_set_heap = true;
    set_heap();
}

}  // namespace regionmesh
