#include "compare/box_tree.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace regionmesh {

EightBoxes::EightBoxes() {
    for (int axis = 0; axis < 3; ++axis) {
        low[axis].fill(std::numeric_limits<float>::infinity());
        high[axis].fill(-std::numeric_limits<float>::infinity());
    }
}

void EightBoxes::put(std::uint32_t lane, const FloatBox& box) {
    for (int axis = 0; axis < 3; ++axis) {
        low[axis][lane] = box.low[axis];
        high[axis][lane] = box.high[axis];
    }
}

FloatBox EightBoxes::hull() const {
    FloatBox box;
    for (int axis = 0; axis < 3; ++axis) {
        box.low[axis] = *std::ranges::min_element(low[axis]);
        box.high[axis] = *std::ranges::max_element(high[axis]);
    }
    return box;
}

BoxTree::BoxTree(std::span<const FloatBox> boxes, std::vector<std::uint32_t> names) : names_(std::move(names)) {
    if (boxes.empty()) return;
    std::vector<FloatBox> hulls;
    for (bool is_root = false; !is_root; boxes = hulls) {
        starts_.push_back(static_cast<std::uint32_t>(nodes_.size()));
        const std::size_t start = nodes_.size();
        nodes_.resize(start + (boxes.size() + EightBoxes::kCount - 1) / EightBoxes::kCount);
        for (std::size_t n = 0; n < boxes.size(); ++n)
            nodes_[start + n / EightBoxes::kCount].put(n % EightBoxes::kCount, boxes[n]);
        std::vector<FloatBox> above;
        for (std::size_t n = start; n < nodes_.size(); ++n) above.push_back(nodes_[n].hull());
        hulls = std::move(above);
        is_root = hulls.size() == 1;
    }
}

}  // namespace regionmesh
