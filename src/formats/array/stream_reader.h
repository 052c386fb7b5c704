// Reads volumes whose samples form one stream, forward, along z.
#pragma once

#include <cstdint>
#include <memory>

#include "formats/codec/byte_stream.h"
#include "formats/codec/sample_format.h"
#include "regionmesh/read_sections.h"

namespace regionmesh::formats {

/// Where the samples of a volume lie in its stream: x fastest, then y, then z.
struct StreamLayout {
    std::uint64_t offset = 0;  // of the first sample, in bytes of the stream
    SampleFormat format;
    std::uint32_t components = 1;  // values at each sample
    std::uint32_t component = 0;   // the index of the value to read
};

/// Requires info.source, format, type and lattice; the options give the spacing and the sweep, which must be along z:
/// `remedy` ends the error if it is not. The caller checks sizes against the file first, since streams have no length.
/// Holds 2^17 samples with all their components.
std::unique_ptr<SectionReader> open_stream(std::unique_ptr<ByteStream> stream, VolumeInfo info,
                                           const StreamLayout& layout, const ReadOptions& options,
                                           const std::string& remedy = "give --sweep z");

/// Throws if `packed_bytes` of a deflated file cannot inflate to `needed` bytes.
void check_inflated(const std::filesystem::path& path, std::uint64_t packed_bytes, std::uint64_t needed);

}  // namespace regionmesh::formats
