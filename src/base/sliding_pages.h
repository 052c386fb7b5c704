// An array of which only a window is kept, in pages: memory is that of the window, whatever was released before.
#pragma once

#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <type_traits>
#include <vector>

#include "regionmesh/error.h"

namespace regionmesh {

/// Like SlidingArray, but elements never move, and a page is released as soon as no element in it is kept. An element
/// is found with one look-up more.
template <class T>
class SlidingPages {
    static_assert(std::is_trivially_copyable_v<T>);

public:
    std::uint32_t first() const { return first_; }
    std::uint32_t end() const { return end_; }

    T& operator[](std::uint32_t n) {
        assert(n >= first_ && n < end_);
        return pages_[(n >> kBits) - first_page_][n & kMask];
    }
    const T& operator[](std::uint32_t n) const {
        assert(n >= first_ && n < end_);
        return pages_[(n >> kBits) - first_page_][n & kMask];
    }
    void push_back(const T& value) {
        if (end_ >> kBits == page_end()) add_page();
        pages_.back()[end_++ & kMask] = value;
    }
    /// New elements before `end` are copies of `value`.
    void grow(std::uint32_t end, const T& value = T{}) {
        while (end_ < end) push_back(value);
    }
    /// Releases the elements before n.
    void drop_before(std::uint32_t n) {
        assert(n <= end_);
        if (n <= first_) return;
        first_ = n;
        const std::uint32_t dropped = (n >> kBits) - first_page_;
        if (dropped == 0) return;
        pages_.erase(pages_.begin(), pages_.begin() + dropped);
        first_page_ += dropped;
    }
    std::size_t bytes() const { return pages_.size() * kPage * sizeof(T); }

private:
    /// Elements of a page: about 16 KiB.
    static constexpr std::uint32_t kPage = std::bit_floor(std::uint32_t{(16 << 10) / sizeof(T)});
    static constexpr std::uint32_t kMask = kPage - 1, kBits = std::bit_width(kMask);

    std::uint32_t page_end() const { return first_page_ + static_cast<std::uint32_t>(pages_.size()); }
    /// Throws Error(kInput) near 2^32 elements, where numbers would begin again.
    void add_page() {
        if (page_end() == ~std::uint32_t{0} >> kBits)
            throw Error(ErrorCode::kInput,
                        "smoothing: more than 2^32 faces before decimation; make the model in blocks (--block-size)");
        pages_.push_back(std::make_unique_for_overwrite<T[]>(kPage));
    }

    std::vector<std::unique_ptr<T[]>> pages_;
    std::uint32_t first_page_ = 0, first_ = 0, end_ = 0;
};

}  // namespace regionmesh
