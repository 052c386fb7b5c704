// How much memory a run takes, foreseen from the size of a volume.
#pragma once

#include <cstdint>

#include "regionmesh/section_reader.h"

namespace regionmesh {

/// Bytes that the process holds with a model of `faces` faces that it simplifies, reading and meshing included.
std::uint64_t expected_bytes(const VolumeInfo& volume, std::uint64_t faces);

}  // namespace regionmesh
