// Sections from standard input.
#pragma once

#include <array>
#include <filesystem>
#include <memory>

#include "formats/codec/byte_stream.h"
#include "formats/codec/sample_format.h"
#include "regionmesh/read_sections.h"

namespace regionmesh::formats {

/// What the header of an array says.
struct StreamedHeader {
    std::array<std::uint32_t, 3> size;
    SampleFormat format;
};

/// Reads the header of an npy file and leaves the stream at the first sample. `path` names it in errors.
StreamedHeader read_npy_header(const std::filesystem::path& path, ByteStream& stream);

/// Standard input: raw samples where the options give size and type, else an npy file in C order. It can be read once,
/// along z.
std::unique_ptr<SectionReader> open_pipe(const ReadOptions& options);

}  // namespace regionmesh::formats
