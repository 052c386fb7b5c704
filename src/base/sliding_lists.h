// Lists of numbers, one for each element of a sliding window.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include "base/sliding_array.h"

namespace regionmesh {

/// The lists of elements 0, 1, 2, ... in one array; lists at the front can be released.
class SlidingLists {
public:
    SlidingLists() { start_.push_back(0); }

    std::uint32_t end() const { return start_.end() - 1; }
    std::span<const std::uint32_t> of(std::uint32_t n) const {
        return {items_.data() + (start_[n] - base_), start_[n + 1] - start_[n]};
    }
    /// Adds the list of the next element.
    void push_back(std::span<const std::uint32_t> list) {
        for (std::uint32_t item : list) items_.push_back(item);
        start_.push_back(base_ + items_.size());
    }
    /// Releases the lists of elements before n.
    void drop_before(std::uint32_t n) {
        start_.drop_before(n);
        const std::uint32_t dropped = start_[n] - base_;
        if (dropped < items_.size() / 4 || dropped == 0) return;
        std::copy(items_.begin() + dropped, items_.end(), items_.begin());
        items_.resize(items_.size() - dropped);
        items_.trim();
        base_ += dropped;
    }
    std::size_t bytes() const { return start_.bytes() + items_.bytes(); }

private:
    SlidingArray<std::uint32_t> start_;  // counted from the first item ever, modulo 2^32
    FlatArray<std::uint32_t> items_;
    std::uint32_t base_ = 0;  // index of items_[0]
};

}  // namespace regionmesh
