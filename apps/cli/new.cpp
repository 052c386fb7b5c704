// The program's operator new: large blocks are put on huge pages (regionmesh/huge_pages.h).
#include <cstdlib>
#include <new>

#include "regionmesh/huge_pages.h"

void* operator new(std::size_t size) {
    for (;;) {
        if (void* block = std::malloc(size == 0 ? 1 : size)) {
            regionmesh::prefer_huge_pages(block, size);
            return block;
        }
        const std::new_handler handler = std::get_new_handler();
        if (!handler) throw std::bad_alloc();
        handler();
    }
}

void operator delete(void* block) noexcept { std::free(block); }
void operator delete(void* block, std::size_t) noexcept { std::free(block); }
