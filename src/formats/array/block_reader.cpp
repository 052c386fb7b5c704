#include "formats/array/block_reader.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "formats/array/numbered_sections.h"
#include "formats/array/volume_size.h"

namespace regionmesh::formats {
namespace {

constexpr std::uint64_t kFewBytes = std::uint64_t{1} << 20;      // smaller blocks get more sections
constexpr std::uint64_t kCrossBytes = std::uint64_t{256} << 20;  // most bytes of a block, for sweeps along x and y

class BlockReader final : public NumberedSections {
public:
    BlockReader(std::unique_ptr<BlockSource> source, VolumeInfo info, const BlockLayout& layout)
        : NumberedSections(std::move(info)), source_(std::move(source)), format_(layout.format) {
        section_bytes_ = std::uint64_t{section_width()} * section_height() * sample_bytes(format_.type);
        chunk_ = std::clamp<std::uint64_t>(layout.chunk[info_.sweep.axes[2]], 1, section_count());
        depth_ = chunk_ * std::max<std::uint64_t>(1, kFewBytes / section_bytes_ / chunk_);
        const std::uint64_t most = layout.is_backed ? kMaxBlockBytes : kMaxBareBytes;
        depth_ = std::min({depth_, std::max<std::uint64_t>(1, most / section_bytes_), std::uint64_t{section_count()}});
        info_.held_bytes = depth_ * section_bytes_ + layout.source_bytes;
    }

private:
    void read_section(std::uint32_t number, std::span<InputLabel> section) override {
        if (number < block_.first || number - block_.first >= block_.count) load(number);
        decode_samples(samples_.data() + (number - block_.first) * section_bytes_, sample_bytes(format_.type), format_,
                       section);
    }

    /// A block that is less deep than a chunk ends where the chunk ends.
    void load(std::uint32_t first) {
        block_.count = 0;
        std::uint64_t end = first + depth_;
        if (depth_ < chunk_) end = std::min(end, (first / chunk_ + 1) * chunk_);
        end = std::min<std::uint64_t>(end, section_count());
        const Block block{info_.sweep, first, static_cast<std::uint32_t>(end - first)};
        samples_.resize(block.count * section_bytes_);
        source_->read(block, samples_);
        block_ = block;
    }

    std::unique_ptr<BlockSource> source_;
    SampleFormat format_;
    std::uint64_t section_bytes_ = 0;
    std::uint64_t chunk_ = 1;  // sections that one chunk crosses
    std::uint64_t depth_ = 1;  // sections of a block
    std::vector<std::byte> samples_;
    Block block_;
};

}  // namespace

std::unique_ptr<SectionReader> open_blocks(std::unique_ptr<BlockSource> source, VolumeInfo info,
                                           const BlockLayout& layout, const ReadOptions& options) {
    const auto& size = info.lattice.size;
    const std::uint64_t samples = volume_bytes(info.source, size, 1);
    for (const int axis : {0, 1}) {
        const std::uint64_t deep = std::min<std::uint64_t>(layout.chunk[axis], size[axis]);
        info.can_sweep[axis] = samples / size[axis] <= kCrossBytes / sample_bytes(layout.format.type) / deep;
    }
    apply_options(info, options, "give --sweep z, or store it in chunks that are less deep");
    return std::make_unique<BlockReader>(std::move(source), std::move(info), layout);
}

}  // namespace regionmesh::formats
