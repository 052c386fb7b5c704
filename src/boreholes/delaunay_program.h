// Where regionmesh-delaunay is.
#pragma once

#include <filesystem>

namespace regionmesh::formats {

/// The program regionmesh-delaunay: `given` if that is not empty, else what the environment variable
/// REGIONMESH_DELAUNAY names, else beside the running program, else on PATH. Throws Error(kInput) saying where it was
/// looked for.
std::filesystem::path find_delaunay(const std::filesystem::path& given);

}  // namespace regionmesh::formats
