// Reconstructs one block: the faces of its own cells, smoothed as in the whole volume.
#pragma once

#include "blocks/block_faces.h"
#include "blocks/block_grid.h"
#include "regionmesh/reconstruct.h"

namespace regionmesh {

/// Samples that are read round a block, so that its own faces are those of the whole volume, bit for bit. Throws
/// Error(kInput) for a filter that looks farther than a bounded number of samples.
std::array<std::uint32_t, 3> halo_of(const SourceShape& shape, const ReconstructOptions& options);

/// The faces whose centroids lie in the block, as a chunk that carries nothing. Its active vertices are those that
/// faces of other blocks share; they are numbered in increasing order. Positions are bit for bit those of the whole.
Chunk own_faces(const BlockVolume& volume, const BlockGrid& grid, std::uint32_t block,
                const ReconstructOptions& options);

}  // namespace regionmesh
