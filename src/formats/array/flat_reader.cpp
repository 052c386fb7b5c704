#include "formats/array/flat_reader.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "formats/array/volume_size.h"

namespace regionmesh::formats {
namespace {

constexpr std::uint64_t kBlockBytes = std::uint64_t{64} << 20;  // sections across the file's order, read together
constexpr std::uint64_t kBlockSections = 64;
constexpr std::uint64_t kStraightBlockBytes = std::uint64_t{1} << 20;  // sections in the file's order
constexpr std::uint64_t kChunkBytes = std::uint64_t{4} << 20;
constexpr std::uint64_t kFarPitch = std::uint64_t{64} << 10;  // runs farther apart are read one by one

/// A block is a run of sections in the file's own order of axes: the file cut down to those sections.
/// With s the swept axis, it is `run_count` runs of bytes, one for each index of the axes slower than s.
class FlatReader final : public SectionReader {
public:
    FlatReader(InputFile file, VolumeInfo info, const FlatLayout& layout)
        : file_(std::move(file)), info_(std::move(info)), layout_(layout), bytes_(sample_bytes(layout.format.type)) {
        const int swept = info_.sweep.axes[2];
        bool is_slower = false;
        for (const int axis : layout_.order) {
            if (axis == swept) {
                is_slower = true;
            } else {
                (is_slower ? run_count_ : inner_bytes_) *= info_.lattice.size[axis];
            }
        }
        inner_bytes_ *= bytes_;
        const std::uint64_t budget = run_count_ == 1 ? kStraightBlockBytes : kBlockBytes;
        const std::uint64_t most = std::min<std::uint64_t>(kBlockSections, section_count());
        block_sections_ = static_cast<std::uint32_t>(std::clamp<std::uint64_t>(budget / section_bytes(), 1, most));
        info_.held_bytes = block_sections_ * section_bytes() + (run_count_ == 1 ? 0 : kChunkBytes);
    }

    const VolumeInfo& info() const override { return info_; }

    bool next(std::span<InputLabel> section) override {
        assert(section.size() == std::size_t{section_width()} * section_height());
        if (next_ == section_count()) return false;
        if (next_ < block_first_ || next_ - block_first_ >= block_count_) load_block(next_);
        const auto pitch = block_pitches();
        const std::byte* corner = block_.data() + (next_ - block_first_) * pitch[info_.sweep.axes[2]];
        const std::size_t width = section_width();
        for (std::size_t row = 0; row < section_height(); ++row) {
            decode_samples(corner + row * pitch[info_.sweep.axes[1]], pitch[info_.sweep.axes[0]], layout_.format,
                           section.subspan(row * width, width));
        }
        ++next_;
        return true;
    }

    void rewind() override { next_ = 0; }

private:
    std::uint64_t section_bytes() const { return inner_bytes_ * run_count_; }

    /// Bytes from one sample of the block to the next along x, y, z.
    std::array<std::uint64_t, 3> block_pitches() const {
        std::array<std::uint64_t, 3> pitches{};
        std::uint64_t pitch = bytes_;
        for (const int axis : layout_.order) {
            pitches[axis] = pitch;
            pitch *= axis == info_.sweep.axes[2] ? block_count_ : info_.lattice.size[axis];
        }
        return pitches;
    }

    void load_block(std::uint32_t first) {
        block_count_ = 0;
        const std::uint32_t count = std::min(block_sections_, section_count() - first);
        block_.resize(count * section_bytes());
        const std::uint64_t start = layout_.offset + first * inner_bytes_;
        const std::uint64_t run = count * inner_bytes_;
        const std::uint64_t pitch = section_count() * inner_bytes_;
        if (run == pitch) {
            read(start, block_);
        } else if (pitch > kFarPitch) {
            for (std::uint64_t i = 0; i < run_count_; ++i)
                read(start + i * pitch, std::span(block_).subspan(i * run, run));
        } else {
            read_near_runs(start, run, pitch);
        }
        block_first_ = first;
        block_count_ = count;
    }

    /// Short runs close together: reads over the gaps, since a system call costs more than the bytes between.
    void read_near_runs(std::uint64_t start, std::uint64_t run, std::uint64_t pitch) {
        const std::uint64_t runs_per_chunk = kChunkBytes / pitch;
        std::vector<std::byte> chunk(std::min(runs_per_chunk, run_count_) * pitch);
        std::byte* out = block_.data();
        for (std::uint64_t i = 0; i < run_count_; i += runs_per_chunk) {
            const std::uint64_t runs = std::min(runs_per_chunk, run_count_ - i);
            read(start + i * pitch, std::span(chunk).first((runs - 1) * pitch + run));
            for (std::uint64_t j = 0; j < runs; ++j, out += run) std::memcpy(out, chunk.data() + j * pitch, run);
        }
    }

    void read(std::uint64_t offset, std::span<std::byte> bytes) const {
        if (file_.read(offset, bytes) == bytes.size()) return;
        fail_section(file_.path(), next_, "the file became shorter while it was read; start again");
    }

    InputFile file_;
    VolumeInfo info_;
    FlatLayout layout_;
    std::uint64_t bytes_;            // of a sample
    std::uint64_t inner_bytes_ = 1;  // of one index of the swept axis and all of the axes faster than it
    std::uint64_t run_count_ = 1;    // indices of the axes slower than the swept one
    std::uint32_t block_sections_ = 1;
    std::vector<std::byte> block_;
    std::uint32_t block_first_ = 0;
    std::uint32_t block_count_ = 0;
    std::uint32_t next_ = 0;
};

void check_length(const InputFile& file, const VolumeInfo& info, const FlatLayout& layout) {
    const std::uint64_t needed = volume_bytes(file.path(), info.lattice.size, sample_bytes(layout.format.type));
    const std::uint64_t present = file.size() < layout.offset ? 0 : file.size() - layout.offset;
    if (present >= needed) return;
    const std::string text = "the file holds " + std::to_string(present) + " bytes of samples where its header says " +
                             std::to_string(needed) + "; it is truncated, fetch it again";
    if (layout.order[2] != 2) fail(file.path(), text);
    fail_section(file.path(), present / (needed / info.lattice.size[2]), text);
}

}  // namespace

std::unique_ptr<SectionReader> open_flat(InputFile file, VolumeInfo info, const FlatLayout& layout,
                                         const ReadOptions& options) {
    check_length(file, info, layout);
    apply_options(info, options);
    return std::make_unique<FlatReader>(std::move(file), std::move(info), layout);
}

}  // namespace regionmesh::formats
