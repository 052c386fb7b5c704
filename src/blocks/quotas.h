// How many faces each block keeps, so that the whole model has the number asked for.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "blocks/piece.h"

namespace regionmesh {

/// The shares of their faces that blocks keep at the threshold at which all together keep about `target` faces, by the
/// sum of the histograms in the headers.
std::vector<double> shares_at_target(std::span<const PieceHeader> pieces, double target);

/// Faces to which some blocks go down when all have `faces` and more than `target`, by block: the excess comes out of
/// the largest blocks, a hundredth of their faces each. Blocks at their limit give none. Collapses remove two faces at
/// a time, or three at lines, so a block may end two below its goal: all together stay above the target even then, but
/// for the last of them.
std::vector<std::uint64_t> trimmed(std::span<const std::uint64_t> faces, const std::vector<bool>& is_at_limit,
                                   std::uint64_t target);

}  // namespace regionmesh
