// Estimates the memory of a run from the size of a volume.
#pragma once

#include <cstdint>

#include "regionmesh/section_reader.h"

namespace regionmesh {

/// Bytes that the process holds while it simplifies a mesh of `faces` faces, including reading and meshing.
std::uint64_t expected_bytes(const VolumeInfo& volume, std::uint64_t faces);

}  // namespace regionmesh
