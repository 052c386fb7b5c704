// An array of which only a window is kept: it grows at its end and shrinks at its front.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstdint>

#include "regionmesh/flat_array.h"

namespace regionmesh {

/// Elements keep the number under which they were added when earlier ones are released.
template <class T>
class SlidingArray {
public:
    std::uint32_t first() const { return first_; }
    std::uint32_t end() const { return base_ + items_.size(); }

    T& operator[](std::uint32_t n) {
        assert(n >= first_);
        return items_[n - base_];
    }
    const T& operator[](std::uint32_t n) const {
        assert(n >= first_);
        return items_[n - base_];
    }
    void push_back(const T& value) { items_.push_back(value); }
    /// New elements before `end` are copies of `value`.
    void grow(std::uint32_t end, const T& value = T{}) { items_.resize(end - base_, value); }

    /// Releases the elements before n. Their memory is reused once it is a quarter of the total; memory shrinks with
    /// the window.
    void drop_before(std::uint32_t n) {
        first_ = n;
        const std::uint32_t dropped = first_ - base_;
        if (dropped < items_.size() / 4 || dropped == 0) return;
        std::copy(items_.begin() + dropped, items_.end(), items_.begin());
        items_.resize(items_.size() - dropped);
        items_.trim();
        base_ = first_;
    }
    std::size_t bytes() const { return items_.bytes(); }

private:
    FlatArray<T> items_;
    std::uint32_t base_ = 0, first_ = 0;
};

}  // namespace regionmesh
