// What a batch of faces adds to the volumes of the regions.
#pragma once

#include <span>
#include <vector>

#include "mesh/chunk.h"
#include "mesh/region_volumes.h"

namespace regionmesh {

/// Adds the cones over all faces (model/region_volumes.h); `carried` are the batch's carried vertices.
inline void add_volumes(const Chunk& batch, std::span<const ChunkVertex> carried, std::vector<double>& volumes) {
    const auto place = [&](std::uint32_t local) {
        return local < batch.carried ? carried[local].position : batch.vertices[local - batch.carried].position;
    };
    for (const auto& [v, labels] : batch.faces) add_cone(volumes, labels, place(v[0]), place(v[1]), place(v[2]));
}

}  // namespace regionmesh
