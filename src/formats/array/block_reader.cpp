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

class BlockReader final : public CroppedSections {
public:
    BlockReader(std::unique_ptr<BlockSource> source, VolumeInfo info, const BlockLayout& layout)
        : CroppedSections(std::move(info)), source_(std::move(source)), layout_(layout) {
        plan_blocks();
    }

private:
    void read_section(std::uint32_t number, std::span<InputLabel> section) override {
        if (number < first_ || number - first_ >= held_) load(number);
        require_labels(decode_samples(samples_.data() + (number - first_) * section_bytes_,
                                      sample_bytes(layout_.format), layout_.format, section),
                       number, 0, box_.low);
    }

    void plan_blocks() override {
        held_ = 0;
        const int swept = info_.sweep.axes[2];
        section_bytes_ = std::uint64_t{section_width()} * section_height() * sample_bytes(layout_.format);
        chunk_ = std::clamp<std::uint64_t>(layout_.chunk[swept], 1, box_.high[swept]);
        depth_ = chunk_ * std::max<std::uint64_t>(1, kFewBytes / section_bytes_ / chunk_);
        const std::uint64_t most = layout_.is_backed ? kMaxBlockBytes : kMaxBareBytes;
        depth_ = std::min({depth_, std::max<std::uint64_t>(1, most / section_bytes_), std::uint64_t{section_count()}});
        info_.held_bytes = depth_ * section_bytes_ + layout_.source_bytes;
    }

    /// A block that is less deep than a chunk ends where the chunk ends, and so does the first of a part of the volume.
    void load(std::uint32_t number) {
        held_ = 0;
        const int swept = info_.sweep.axes[2];
        const std::uint64_t in_file = std::uint64_t{box_.low[swept]} + number;
        std::uint64_t end = in_file + depth_;
        if (depth_ < chunk_)
            end = std::min(end, (in_file / chunk_ + 1) * chunk_);
        else if (end < box_.high[swept])
            end -= end % chunk_;
        Block block{info_.sweep, box_};
        block.box.low[swept] = static_cast<std::uint32_t>(in_file);
        block.box.high[swept] = static_cast<std::uint32_t>(std::min<std::uint64_t>(end, box_.high[swept]));
        const std::uint32_t count = block.box.size()[swept];
        samples_.resize(count * section_bytes_);
        source_->read(block, samples_);
        first_ = number;
        held_ = count;
    }

    std::unique_ptr<BlockSource> source_;
    BlockLayout layout_;
    std::uint64_t section_bytes_ = 0;
    std::uint64_t chunk_ = 1;  // sections that one chunk crosses
    std::uint64_t depth_ = 1;  // most sections of a block
    std::vector<std::byte> samples_;
    std::uint32_t first_ = 0, held_ = 0;  // sections of the block that is held
};

}  // namespace

std::unique_ptr<SectionReader> open_blocks(std::unique_ptr<BlockSource> source, VolumeInfo info,
                                           const BlockLayout& given, const ReadOptions& options) {
    BlockLayout layout = given;
    order_reals(options, layout.format, info);
    const auto& size = info.lattice.size;
    const std::uint64_t samples = volume_bytes(info.source, size, 1);
    for (const int axis : {0, 1}) {
        const std::uint64_t deep = std::min<std::uint64_t>(layout.chunk[axis], size[axis]);
        info.can_sweep[axis] = samples / size[axis] <= kCrossBytes / sample_bytes(layout.format) / deep;
    }
    apply_options(info, options, "give --sweep z, or store it in chunks that are less deep");
    return std::make_unique<BlockReader>(std::move(source), std::move(info), layout);
}

}  // namespace regionmesh::formats
