// How large blocks are, and which of them are reconstructed together.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "blocks/block_grid.h"
#include "regionmesh/reconstruct.h"
#include "stream/face_source.h"

namespace regionmesh {

/// Cells along an axis of the largest blocks that the memory of the options has room for, of about equal size along the
/// longest axis. `faces` is their number before simplification.
std::uint32_t default_block_cells(const SourceShape& shape, std::uint64_t faces, const ReconstructOptions& options);

/// Throws Error(kInput) where memory has no room for one block of mean size.
void require_block_memory(const std::string& source, const SourceShape& shape, std::uint64_t faces, std::uint32_t cells,
                          const ReconstructOptions& options);

/// Boxes of blocks, each swept in one go (OwnFaces): as large as memory has room for, and a few for each process where
/// there are several. Their order and size do not change the faces.
std::vector<IndexBox> plan_sweeps(const BlockGrid& grid, const SourceShape& shape, std::uint64_t faces,
                                  const ReconstructOptions& options, std::uint32_t processes);

/// Most blocks: each is a file.
inline constexpr double kMostBlocks = 10e6;

/// Throws Error(kInput) where there would be more blocks.
void require_block_count(const VolumeInfo& volume, std::uint32_t cells);

}  // namespace regionmesh
