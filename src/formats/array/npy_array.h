// An .npy file within another file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>

#include "regionmesh/read_sections.h"

namespace regionmesh::formats {

/// Reads the .npy file that begins at `begin` in `path`, plainly or as a raw deflated stream.
std::unique_ptr<SectionReader> open_npy_in(const std::filesystem::path& path, std::uint64_t begin, bool is_deflated,
                                           const ReadOptions& options);

}  // namespace regionmesh::formats
