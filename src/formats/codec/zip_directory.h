// The files within a zip archive.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "formats/input_file.h"

namespace regionmesh::formats {

struct ZipEntry {
    std::string name;
    std::uint64_t begin = 0;         // of the bytes, in the archive
    std::uint64_t packed_bytes = 0;  // as they lie there
    std::uint64_t bytes = 0;
    bool is_deflated = false;  // else stored plainly
};

/// In the order of the directory, archives of 64 bits included. Throws Error(kInput) for a file that is no archive, or
/// a damaged one, and for more than a million entries. Leaves out entries that are encrypted, or packed in another way.
std::vector<ZipEntry> zip_entries(const InputFile& file);

}  // namespace regionmesh::formats
