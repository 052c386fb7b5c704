// Parts of labels between two sections that reach neither.
#pragma once

#include <cstdint>
#include <vector>

namespace regionmesh {

/// Gives the samples of loose parts to neighbours that are not loose, until none is left. A part is loose if it is
/// connected, as in the mesh, to the first layer and the last by no samples of its label. Of the labels of neighbours
/// along the axes the most frequent wins, then the smallest. Changes neither the first layer nor the last. Returns the
/// number of samples given away. Layers have rows of `width` samples.
std::uint64_t give_away_loose_parts(std::vector<std::vector<std::uint32_t>>& layers, std::int32_t width);

}  // namespace regionmesh
