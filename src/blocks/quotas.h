// How many faces each block keeps, so that the whole model has the number asked for.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "blocks/piece.h"

namespace regionmesh {

/// The threshold at which all blocks together keep about `target` faces, by the sum of the histograms in the headers;
/// in units of scale^4.
double threshold_at(std::span<const PieceHeader> pieces, double target);

/// The shares of their faces that blocks keep there, in all the target.
std::vector<double> shares_at(std::span<const PieceHeader> pieces, double target);

}  // namespace regionmesh
