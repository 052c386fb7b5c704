// Reads volumes whose samples are uncompressed and contiguous in one file, along any axis.
#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "formats/codec/sample_format.h"
#include "formats/input_file.h"
#include "regionmesh/read_sections.h"

namespace regionmesh::formats {

/// Where the samples of a volume lie in its file.
struct FlatLayout {
    std::uint64_t offset = 0;  // of the first sample, in bytes
    SampleFormat format;
    std::array<int, 3> order{0, 1, 2};  // axes, the fastest first
};

/// Requires info.source, format, type, lattice and can_sweep; the options give the sweep and the spacing.
/// Throws if the file is shorter than its header says. Holds 4 MiB and the larger of 64 MiB and one section of stored
/// samples.
std::unique_ptr<SectionReader> open_flat(InputFile file, VolumeInfo info, const FlatLayout& layout,
                                         const ReadOptions& options);

}  // namespace regionmesh::formats
