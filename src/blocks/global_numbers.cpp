#include "blocks/global_numbers.h"

#include <algorithm>

#include "base/box.h"
#include "blocks/join.h"

namespace regionmesh {

GlobalNumbers::GlobalNumbers(const Manifest& manifest, const std::filesystem::path& folder)
    : grid_(piece_lattice(manifest), manifest.block_cells, manifest.shift), boxes_(piece_boxes(manifest, folder)) {
    for (std::uint32_t block = 0; block < boxes_.size(); ++block) {
        if (boxes_[block].is_empty()) continue;
        const auto own = grid_.place(block), from = grid_.place(grid_.block_at(boxes_[block].low)),
                   to = grid_.place(grid_.block_at(boxes_[block].high));
        for (int axis = 0; axis < 3; ++axis)
            overhang_[axis] = std::max({overhang_[axis], own[axis] - std::min(own[axis], from[axis]),
                                        to[axis] - std::min(own[axis], to[axis])});
    }
}

void GlobalNumbers::find_later(std::uint32_t block) {
    later_.clear();
    const auto own = grid_.place(block);
    IndexBox near{{}, grid_.counts()};
    for (int axis = 0; axis < 3; ++axis) {
        near.low[axis] = own[axis] - std::min(own[axis], 2 * overhang_[axis]);
        near.high[axis] = std::min(near.high[axis], own[axis] + 2 * overhang_[axis] + 1);
    }
    grid_.for_blocks(near, [&](std::uint32_t other) {
        if (other > block && overlap(boxes_[other], boxes_[block])) later_.push_back(other);
    });
}

std::uint32_t GlobalNumbers::last_with(Vec3 position, std::uint32_t block) const {
    const auto at = std::find_if(later_.rbegin(), later_.rend(), [&](std::uint32_t other) {
        return overlap(boxes_[other], {position, position});
    });
    return at == later_.rend() ? block : *at;
}

std::vector<std::uint64_t> GlobalNumbers::number(const Piece& piece, std::uint32_t block) {
    find_later(block);
    std::vector<std::uint64_t> numbers;
    numbers.reserve(piece.vertices.size());
    for (const PieceVertex& vertex : piece.vertices) {
        numbers.push_back(count_);
        if (vertex.is_shared) {
            const PositionBits bits = bits_of(vertex.position);
            const auto [at, is_new] = seen_.try_emplace(bits, count_);
            if (is_new) to_forget_[last_with(vertex.position, block)].push_back(bits);
            numbers.back() = at->second;
        }
        if (numbers.back() == count_) ++count_;
    }
    if (const auto done = to_forget_.find(block); done != to_forget_.end()) {
        for (const PositionBits& bits : done->second) seen_.erase(bits);
        to_forget_.erase(done);
    }
    return numbers;
}

}  // namespace regionmesh
