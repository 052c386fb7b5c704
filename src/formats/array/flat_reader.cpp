#include "formats/array/flat_reader.h"

#include <algorithm>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "formats/array/numbered_sections.h"
#include "formats/array/volume_size.h"

namespace regionmesh::formats {
namespace {

// Most bytes and sections that are read together across the order of the file, and most bytes in that order.
constexpr std::uint64_t kBlockBytes = std::uint64_t{64} << 20;
constexpr std::uint64_t kBlockSections = 64;
constexpr std::uint64_t kStraightBlockBytes = std::uint64_t{1} << 20;
constexpr std::uint64_t kChunkBytes = std::uint64_t{4} << 20;
constexpr std::uint64_t kFarPitch = std::uint64_t{64} << 10;  // runs with a larger pitch are read one by one

/// A block is some consecutive sections in the file's own order of axes. With s the swept axis, it is `run_count` runs
/// of bytes, one for each index of the axes slower than s.
class FlatReader final : public NumberedSections {
public:
    FlatReader(InputFile file, VolumeInfo info, const FlatLayout& layout)
        : NumberedSections(std::move(info)),
          file_(std::move(file)),
          layout_(layout),
          bytes_(sample_bytes(layout.format.type)) {
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

private:
    void read_section(std::uint32_t number, std::span<InputLabel> section) override {
        if (number < block_first_ || number - block_first_ >= block_count_) load_block(number);
        const auto pitch = block_pitches();
        const std::byte* corner = block_.data() + (number - block_first_) * pitch[info_.sweep.axes[2]];
        const std::size_t width = section_width();
        for (std::size_t row = 0; row < section_height(); ++row) {
            decode_samples(corner + row * pitch[info_.sweep.axes[1]], pitch[info_.sweep.axes[0]], layout_.format,
                           section.subspan(row * width, width));
        }
    }

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
        block_first_ = first;
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
        block_count_ = count;
    }

    /// For short runs that are close together: reads the gaps, too, since a system call costs more than those bytes.
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
        fail_section(file_.path(), block_first_, "the file became shorter while it was read; start again");
    }

    InputFile file_;
    FlatLayout layout_;
    std::uint64_t bytes_;            // of a sample
    std::uint64_t inner_bytes_ = 1;  // of one index of the swept axis, with all faster axes
    std::uint64_t run_count_ = 1;    // product of the sizes of the axes slower than the swept one
    std::uint32_t block_sections_ = 1;
    std::vector<std::byte> block_;
    std::uint32_t block_first_ = 0;
    std::uint32_t block_count_ = 0;
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
