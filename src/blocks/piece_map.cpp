#include "blocks/piece_map.h"

#include <algorithm>
#include <utility>

namespace regionmesh {

PieceMap::PieceMap(const BlockGrid& grid, std::vector<Box> boxes) : grid_(grid), boxes_(std::move(boxes)) {
    for (std::uint32_t block = 0; block < boxes_.size(); ++block) {
        if (boxes_[block].is_empty()) continue;
        const auto own = grid_.place(block), from = grid_.place(grid_.block_at(boxes_[block].low)),
                   to = grid_.place(grid_.block_at(boxes_[block].high));
        for (int axis = 0; axis < 3; ++axis)
            overhang_[axis] = std::max({overhang_[axis], own[axis] - std::min(own[axis], from[axis]),
                                        to[axis] - std::min(own[axis], to[axis])});
    }
}

}  // namespace regionmesh
