// The pairs of labels that meet.
#pragma once

#include <algorithm>
#include <cstdint>
#include <unordered_set>

#include "regionmesh/label.h"

namespace regionmesh {

/// A set of pairs of labels. Adding the pair that was added last is fast, and the most frequent case.
class LabelPairs {
public:
    void add(Label a, Label b) {
        const std::uint64_t pair = std::uint64_t{std::min(a, b)} << 32 | std::max(a, b);
        if (pair == last_) return;
        last_ = pair;
        pairs_.insert(pair);
    }
    std::uint64_t size() const { return pairs_.size(); }

private:
    std::unordered_set<std::uint64_t> pairs_;
    std::uint64_t last_ = 0;
};

}  // namespace regionmesh
