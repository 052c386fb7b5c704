// An array of which only a window is kept: it grows at its end and is let go at its front.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstdint>

#include "regionmesh/flat_array.h"

namespace regionmesh {

/// Elements have the number under which they were added, whatever has been let go before them.
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
    /// Elements before `end` that are new are copies of `value`.
    void grow(std::uint32_t end, const T& value = T{}) { items_.resize(end - base_, value); }

    /// Lets go of the elements before n. Their place is taken back when it is a quarter of all; memory
    /// falls as the window does.
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
