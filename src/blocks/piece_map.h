// Where the pieces of a model lie.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/box.h"
#include "blocks/block_grid.h"

namespace regionmesh {

/// Finds the pieces in a box without a look at all of them. A piece has the faces of its block, some of which reach
/// into the blocks round it.
class PieceMap {
public:
    /// `boxes` are those of the pieces, by block; empty where there are no faces.
    PieceMap(const BlockGrid& grid, std::vector<Box> boxes);

    const std::vector<Box>& boxes() const { return boxes_; }

    /// Calls visit(block) for each piece whose box has a point in common with this one, in their order.
    template <class Visit>
    void for_pieces_at(const Box& box, Visit&& visit) const {
        const auto from = grid_.place(grid_.block_at(box.low)), to = grid_.place(grid_.block_at(box.high));
        IndexBox near{{}, grid_.counts()};
        for (int axis = 0; axis < 3; ++axis) {
            near.low[axis] = from[axis] - std::min(from[axis], overhang_[axis]);
            near.high[axis] = std::min(near.high[axis], to[axis] + overhang_[axis] + 1);
        }
        grid_.for_blocks(near, [&](std::uint32_t block) {
            if (!boxes_[block].is_empty() && overlap(boxes_[block], box)) visit(block);
        });
    }

private:
    BlockGrid grid_;
    std::vector<Box> boxes_;
    std::array<std::uint32_t, 3> overhang_{};  // blocks by which the box of a piece exceeds its block, at most
};

}  // namespace regionmesh
