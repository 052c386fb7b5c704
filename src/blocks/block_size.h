// How large blocks are.
#pragma once

#include <cstdint>

#include "regionmesh/reconstruct.h"
#include "stream/face_source.h"

namespace regionmesh {

/// Cells along an axis of the largest blocks that the memory of the options has room for, of about equal size along the
/// longest axis. `faces` is their number before simplification.
std::uint32_t default_block_cells(const SourceShape& shape, std::uint64_t faces, const ReconstructOptions& options);

/// Throws Error(kInput) where there would be too many blocks, each of which is a file.
void require_block_count(const VolumeInfo& volume, std::uint32_t cells);

}  // namespace regionmesh
