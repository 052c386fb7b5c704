// Numbers of vertices over all pieces of a model.
#pragma once

#include <cstdint>
#include <filesystem>
#include <unordered_map>
#include <vector>

#include "blocks/gather.h"
#include "blocks/manifest.h"
#include "blocks/piece.h"
#include "blocks/piece_map.h"

namespace regionmesh {

/// Numbers the vertices of a model from 0, in the order of the pieces and, in each, of its vertices. A vertex that
/// several pieces have gets one number, in the first of them. Holds the positions that later pieces may have, too: 80
/// bytes each.
class GlobalNumbers {
public:
    /// Reads the headers of the pieces.
    GlobalNumbers(const Manifest& manifest, const std::filesystem::path& folder);

    /// The numbers of the vertices of a piece. Requires the pieces in the order of their blocks; those without vertices
    /// may be left out.
    std::vector<std::uint64_t> number(const Piece& piece, std::uint32_t block);
    /// How many vertices have a number.
    std::uint64_t count() const { return count_; }

private:
    void find_later(std::uint32_t block);
    /// The last block whose piece may have a vertex.
    std::uint32_t last_with(Vec3 position, std::uint32_t block) const;

    PieceMap pieces_;
    std::vector<std::uint32_t> later_;  // pieces after this one whose boxes meet its box
    std::unordered_map<PositionBits, std::uint64_t, PositionHash> seen_;
    std::unordered_map<std::uint32_t, std::vector<PositionBits>> to_forget_;  // by that block
    std::uint64_t count_ = 0;
};

}  // namespace regionmesh
