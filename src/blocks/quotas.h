// The threshold for all blocks at which the whole model has the number of faces asked for.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "blocks/piece.h"

namespace regionmesh {

/// The threshold at which all blocks together keep about `target` faces, by the sum of the histograms in the headers;
/// in units of scale^4.
double threshold_at(std::span<const PieceHeader> pieces, double target);

/// The share of its faces that each block keeps at this threshold, scaled so that all blocks together keep the target.
std::vector<double> shares_at(std::span<const PieceHeader> pieces, double target);

}  // namespace regionmesh
