// The share of a chunk in the volumes of the regions.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "mesh/region_volumes.h"
#include "surface/chunk.h"

namespace regionmesh {

/// Adds the cones over all faces (mesh/region_volumes.h); `carried` are the vertices that the chunk carries.
inline void add_volumes(const Chunk& chunk, std::span<const ChunkVertex> carried, std::vector<double>& volumes,
                        std::optional<Vec3>& apex) {
    const auto position = [&](std::uint32_t local) { return vertex_of(chunk, carried, local).position; };
    for (const auto& [v, labels] : chunk.faces)
        add_cone(volumes, apex, labels, position(v[0]), position(v[1]), position(v[2]));
}

}  // namespace regionmesh
