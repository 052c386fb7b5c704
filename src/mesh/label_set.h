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
        for (int i = 0; i < size_; ++i)
            if (labels_[i] == label) return;
        if (size_ < kCapacity) labels_[size_++] = label;
    }
    bool contains(Label label) const {
        for (int i = 0; i < size_; ++i)
            if (labels_[i] == label) return true;
        return false;
    }
    int size() const { return size_; }
    const Label* begin() const { return labels_.data(); }
    const Label* end() const { return labels_.data() + size_; }

private:
    int size_ = 0;
    std::array<Label, kCapacity> labels_;
};

}  // namespace regionmesh
