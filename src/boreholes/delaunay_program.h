// Locates the program regionmesh-delaunay.
#pragma once

#include <filesystem>

namespace regionmesh::formats {

/// The path of regionmesh-delaunay: `given` if not empty; otherwise the value of the environment variable
/// REGIONMESH_DELAUNAY, the folder of the running program, or a folder on PATH. Throws Error(kInput) that lists these
/// places.
std::filesystem::path find_delaunay(const std::filesystem::path& given);

}  // namespace regionmesh::formats
