// A small set of labels: those that meet at a vertex or an edge.
#pragma once

#include <array>
#include <cstdint>

#include "regionmesh/label.h"

namespace regionmesh {

/// At most kCapacity labels in order of insertion; further ones are dropped (only surfaces with violations have more).
class LabelSet {
public:
    static constexpr int kCapacity = 16;

    void add(Label label) {
        labels_[size_] = label;
        size_ += !contains(label) & (size_ < kCapacity);
    }
    /// No branches that depend on labels: they would be mispredicted.
    bool contains(Label label) const {
        bool has = false;
        for (int i = 0; i < size_; ++i) has |= labels_[i] == label;
        return has;
    }
    int size() const { return size_; }
    const Label* begin() const { return labels_.data(); }
    const Label* end() const { return labels_.data() + size_; }

private:
    int size_ = 0;
    std::array<Label, kCapacity + 1> labels_;  // room for one that is not added
};

}  // namespace regionmesh
