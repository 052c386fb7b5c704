// How many faces each block keeps, so that the whole model has the number asked for.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "blocks/piece.h"

namespace regionmesh {

/// The threshold at which all blocks together keep about `target` faces, by the sum of the histograms in the headers;
/// in units of scale^4.
double threshold_at(std::span<const PieceHeader> pieces, double target);

/// The shares of their faces that blocks keep there, in all the target.
std::vector<double> shares_at(std::span<const PieceHeader> pieces, double target);

/// How many collapses of the log of each piece are made so that the target is left of `faces`: the lowest levels first,
/// in the order of the pieces where they are equal. The last may leave one or two less.
std::vector<std::uint64_t> cut(std::span<const std::filesystem::path> pieces, std::uint64_t faces,
                               std::uint64_t target);

/// Makes the first `count` collapses of the log of a piece, and drops the others.
void make_collapses(Piece& piece, std::uint64_t count);

}  // namespace regionmesh
