// Levels of detail of a model in pieces.
#pragma once

#include <cstdint>
#include <functional>

#include "blocks/precomputed/precomputed.h"
#include "regionmesh/mesh.h"

namespace regionmesh {

/// Each level has about an eighth of the faces of the one before, as many as its chunks are fewer.
inline constexpr std::uint32_t kFacesPerLevel = 8;

/// As many levels as leave the last one 20,000 faces or more, and eight at most.
std::uint32_t level_count(std::uint64_t faces);

/// Calls visit(level, mesh) for all parts of all levels, the mesh in the space of the model. Level 0 is the model,
/// piece by piece. Level 1 is made of the pieces, level n + 1 of eight neighbouring parts of level n joined: the
/// vertices that other parts use stay, everything else is simplified to an eighth, so parts fit together and so do
/// regions. Holds as many faces as a piece has; the parts of the last level lie in a temporary file. Samples do not
/// stay in their regions.
void for_each_level(const Precomputed& precomputed, std::uint32_t levels,
                    const std::function<void(std::uint32_t level, const Mesh& mesh)>& visit);

}  // namespace regionmesh
