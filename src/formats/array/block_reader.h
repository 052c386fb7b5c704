// Reads volumes that are stored in chunks: runs of sections at a time, each as deep as a chunk.
#pragma once

#include <memory>

#include "formats/codec/sample_format.h"
#include "regionmesh/read_sections.h"

namespace regionmesh::formats {

/// No chunk may hold more bytes of samples; what needs one at a time is bounded with it.
inline constexpr std::uint64_t kMaxChunkBytes = std::uint64_t{1} << 30;

/// A run of consecutive sections of a sweep.
struct Block {
    Sweep sweep;
    std::uint32_t first = 0;
    std::uint32_t count = 0;
};

/// Where blocks come from.
class BlockSource {
public:
    virtual ~BlockSource() = default;

    /// Fills `samples`, stored as they are in the file: axes[0] of the sweep fastest, sections one after another.
    /// Throws Error(kInput) naming file and section.
    virtual void read(const Block& block, std::span<std::byte> samples) = 0;
};

struct BlockLayout {
    SampleFormat format;
    std::array<std::uint64_t, 3> chunk{1, 1, 1};  // samples along x, y, z that are best read together
    std::uint64_t source_bytes = 0;               // that the source holds beside the block
    bool is_backed = true;                        // there is enough in the file to fill a block; else few are held
};

/// Most bytes of a block of more than one section, or of one that little stands behind.
inline constexpr std::uint64_t kMaxBlockBytes = std::uint64_t{1} << 30;
inline constexpr std::uint64_t kMaxBareBytes = std::uint64_t{64} << 20;

/// Requires info.source, format, type and lattice; the options give the sweep and the spacing. Holds one block: as many
/// sections as a chunk is deep, or a MiB of thin ones. Along z always; where a chunk's depth of sections is more than a
/// GiB (64 MiB where the file is too small for that), fewer are held, and chunks read again for the next block. Along x
/// and y where that depth takes 256 MiB or less.
std::unique_ptr<SectionReader> open_blocks(std::unique_ptr<BlockSource> source, VolumeInfo info,
                                           const BlockLayout& layout, const ReadOptions& options);

}  // namespace regionmesh::formats
