// How many faces fit in the memory given.
#pragma once

#include <cstdint>
#include <limits>

#include "regionmesh/volume/section_reader.h"

namespace regionmesh {

/// Most faces that a model can have: they are numbered in 32 bits.
inline constexpr std::uint64_t kMostFaces = std::numeric_limits<std::uint32_t>::max();

/// Bytes a face of the model, with what decimation adds (docs/memory.md).
inline constexpr std::uint64_t kBytesPerFace = 96;

/// Bytes a face that smoothing holds, with half a vertex (docs/memory.md).
inline constexpr std::uint64_t kSmoothingBytesPerFace = 100;

/// Faces that a model may have within `memory` bytes, beside the sections and tables that reading needs and `smoothing`
/// bytes. Throws Error(kInput) when those alone take more.
std::uint64_t face_budget_for(std::uint64_t memory, const VolumeInfo& volume, std::uint64_t smoothing = 0);

/// Bytes that reading and meshing take beside the model.
std::uint64_t reading_bytes(const VolumeInfo& volume);

}  // namespace regionmesh
