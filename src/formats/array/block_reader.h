// Reads volumes that are stored in chunks, several consecutive sections at a time.
#pragma once

#include <memory>

#include "formats/codec/sample_format.h"
#include "regionmesh/read_sections.h"

namespace regionmesh::formats {

/// Largest chunk, in bytes of samples: bounds the memory of readers that hold one chunk.
inline constexpr std::uint64_t kMaxChunkBytes = std::uint64_t{1} << 30;

/// Samples of the file: consecutive sections of a sweep.
struct Block {
    Sweep sweep;
    IndexBox box;

    std::uint32_t first() const { return box.low[sweep.axes[2]]; }
};

/// Reads blocks from a file.
class BlockSource {
public:
    virtual ~BlockSource() = default;

    /// Fills `samples` with those of the box, in the sample format of the file: axes[0] of the sweep fastest, sections
    /// one after another. Throws Error(kInput) that names file and section.
    virtual void read(const Block& block, std::span<std::byte> samples) = 0;
};

struct BlockLayout {
    SampleFormat format;
    std::array<std::uint64_t, 3> chunk{1, 1, 1};  // samples along x, y, z that are best read together
    std::uint64_t source_bytes = 0;               // memory of the source in addition to the block
    bool is_backed = true;                        // whether the file is large enough to fill a block
};

/// Most bytes of a block of several sections; the second if the file is too small to fill a block.
inline constexpr std::uint64_t kMaxBlockBytes = std::uint64_t{1} << 30;
inline constexpr std::uint64_t kMaxBareBytes = std::uint64_t{64} << 20;

/// Requires info.source, format, type and lattice; the options give the sweep and the spacing. Holds one block: as many
/// sections as a chunk is deep, or more if they take less than a MiB. Every volume can be swept along z; if the depth
/// of a chunk takes more than a GiB (64 MiB if the file is too small for that), a block has fewer sections, and chunks
/// are read again for the next block. Sweeps along x and y are allowed if the depth of a chunk takes 256 MiB or less.
std::unique_ptr<SectionReader> open_blocks(std::unique_ptr<BlockSource> source, VolumeInfo info,
                                           const BlockLayout& layout, const ReadOptions& options);

}  // namespace regionmesh::formats
