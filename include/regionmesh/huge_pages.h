// Large arrays on huge pages.
#pragma once

#include <cstddef>

namespace regionmesh {

/// Asks the system to put a large block of memory on huge pages, before it is written: otherwise the first write to
/// each small page costs a page fault, in a virtual machine ten microseconds and more. A request: does nothing where
/// the system has no huge pages, where memory is short (note_memory_room), and for small blocks.
void prefer_huge_pages(void* block, std::size_t bytes);

}  // namespace regionmesh
