// Makes the collapses in the logs of pieces that lead to the target.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "blocks/piece.h"

namespace regionmesh {

/// How many collapses of the log of each piece are made so that the target is left of `faces`: the lowest levels first,
/// in the order of the pieces where they are equal. The last one, of those about as low, leaves the least below the
/// target: one face, unless all of these are at lines.
std::vector<std::uint64_t> cut(std::span<const std::filesystem::path> pieces, std::uint64_t faces,
                               std::uint64_t target);

/// Makes the first `count` collapses of the log of a piece (all if it has fewer), and drops the others.
void make_collapses(Piece& piece, std::uint64_t count);

}  // namespace regionmesh
