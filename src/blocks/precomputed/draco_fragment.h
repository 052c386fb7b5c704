// A fragment of a mesh, compressed by Draco.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace regionmesh {

/// Faces of one region in one chunk; positions in steps from the corner of the chunk.
struct FragmentMesh {
    std::vector<std::array<std::uint16_t, 3>> positions;
    std::vector<std::array<std::uint32_t, 3>> faces;
};

/// Draco keeps the positions, which it stores as integers, and the faces, which it puts into another order. A vertex
/// may be there several times after it. Throws Error(kOutput) where Draco fails, and in a build without it.
std::string encode_draco(const FragmentMesh& mesh);

}  // namespace regionmesh
