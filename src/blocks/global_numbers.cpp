#include "blocks/global_numbers.h"

#include <algorithm>

#include "base/box.h"
#include "blocks/join.h"

namespace regionmesh {

GlobalNumbers::GlobalNumbers(const Manifest& manifest, const std::filesystem::path& folder)
    : pieces_(piece_map(manifest, folder)) {}

void GlobalNumbers::find_later(std::uint32_t block) {
    later_.clear();
    pieces_.for_pieces_at(pieces_.boxes()[block], [&](std::uint32_t other) {
        if (other > block) later_.push_back(other);
    });
}

std::uint32_t GlobalNumbers::last_with(Vec3 position, std::uint32_t block) const {
    const auto at = std::find_if(later_.rbegin(), later_.rend(), [&](std::uint32_t other) {
        return overlap(pieces_.boxes()[other], {position, position});
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
