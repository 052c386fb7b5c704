#include "formats/array/flat_reader.h"

#include <algorithm>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "base/reused_vector.h"
#include "formats/array/numbered_sections.h"
#include "formats/array/volume_size.h"

namespace regionmesh::formats {
namespace {

// What is read together across the order of the file: so many sections, but at least and at most so many bytes. In that
// order it is kStraightBlockBytes.
constexpr std::uint64_t kBlockSections = 64;
constexpr std::uint64_t kLeastBlockBytes = std::uint64_t{4} << 20, kMostBlockBytes = std::uint64_t{64} << 20;
constexpr std::uint64_t kStraightBlockBytes = std::uint64_t{1} << 20;
constexpr std::uint64_t kChunkBytes = std::uint64_t{1} << 20;
constexpr std::uint64_t kFarPitch = std::uint64_t{64} << 10;  // runs with a larger pitch are read one by one

/// A block is some consecutive sections in the file's own order of axes: runs of bytes.
class FlatReader final : public CroppedSections {
public:
    FlatReader(InputFile file, VolumeInfo info, const FlatLayout& layout)
        : CroppedSections(std::move(info)),
          file_(std::move(file)),
          layout_(layout),
          bytes_(sample_bytes(layout.format)),
          file_size_(info_.lattice.size) {
        plan_blocks();
    }

private:
    void read_section(std::uint32_t number, std::span<InputLabel> section) override {
        if (number < block_first_ || number - block_first_ >= block_count_) load_block(number);
        const auto pitch = block_pitches();
        const std::byte* corner = block_.data() + (number - block_first_) * pitch[info_.sweep.axes[2]];
        const std::size_t width = section_width();
        for (std::size_t row = 0; row < section_height(); ++row) {
            require_labels(decode_samples(corner + row * pitch[info_.sweep.axes[1]], pitch[info_.sweep.axes[0]],
                                          layout_.format, section.subspan(row * width, width)),
                           number, row * width, box_.low);
        }
    }

    std::uint64_t section_bytes() const { return std::uint64_t{section_width()} * section_height() * bytes_; }

    /// Sections that are swept in the order of the file and not cropped follow each other.
    bool is_straight() const { return info_.sweep.axes[2] == layout_.order[2] && info_.lattice.size == file_size_; }

    void plan_blocks() override {
        block_count_ = 0;
        const std::uint64_t budget =
            is_straight() ? kStraightBlockBytes
                          : std::clamp(kBlockSections * section_bytes(), kLeastBlockBytes, kMostBlockBytes);
        block_sections_ =
            static_cast<std::uint32_t>(std::clamp<std::uint64_t>(budget / section_bytes(), 1, section_count()));
        info_.held_bytes = block_sections_ * section_bytes() + (is_straight() ? 0 : kChunkBytes);
    }

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
        IndexBox box = box_;
        const int swept = info_.sweep.axes[2];
        box.low[swept] += first;
        box.high[swept] = box.low[swept] + count;
        // Along the axes of the file, the fastest first.
        std::uint64_t start = layout_.offset, samples[3], pitch[3], step = bytes_;
        for (int n = 0; n < 3; ++n) {
            const int axis = layout_.order[n];
            samples[n] = box.size()[axis];
            pitch[n] = step;
            start += box.low[axis] * step;
            step *= file_size_[axis];
        }
        // Axes that are read whole continue those before them.
        std::uint64_t run = samples[0] * pitch[0];
        if (run == pitch[1]) {
            run = samples[1] * pitch[1];
            samples[1] = 1;
            if (run == pitch[2]) {
                run = samples[2] * pitch[2];
                samples[2] = 1;
            }
        } else if (samples[1] * pitch[1] == pitch[2]) {
            samples[1] *= samples[2];
            samples[2] = 1;
        }
        std::byte* out = block_.data();
        for (std::uint64_t k = 0; k < samples[2]; ++k)
            out = read_runs(start + k * pitch[2], run, samples[1], pitch[1], out);
        block_count_ = count;
    }

    /// Where runs are short and close together: reads the gaps, too, since a system call costs more than those bytes.
    std::byte* read_runs(std::uint64_t start, std::uint64_t run, std::uint64_t run_count, std::uint64_t pitch,
                         std::byte* out) {
        if (run_count == 1 || pitch > kFarPitch) {
            for (std::uint64_t i = 0; i < run_count; ++i, out += run) read(start + i * pitch, {out, run});
            return out;
        }
        const std::uint64_t runs_per_chunk = kChunkBytes / pitch;
        resize_reused(chunk_, std::min(runs_per_chunk, run_count) * pitch);
        for (std::uint64_t i = 0; i < run_count; i += runs_per_chunk) {
            const std::uint64_t runs = std::min(runs_per_chunk, run_count - i);
            read(start + i * pitch, std::span(chunk_).first((runs - 1) * pitch + run));
            for (std::uint64_t j = 0; j < runs; ++j, out += run) std::memcpy(out, chunk_.data() + j * pitch, run);
        }
        return out;
    }

    void read(std::uint64_t offset, std::span<std::byte> bytes) const {
        if (file_.read(offset, bytes) == bytes.size()) return;
        fail_section(file_.path(), block_first_, "the file became shorter while it was read; start again");
    }

    InputFile file_;
    FlatLayout layout_;
    std::uint64_t bytes_;  // of a sample
    std::array<std::uint32_t, 3> file_size_;
    std::uint32_t block_sections_ = 1;
    std::vector<std::byte> block_;
    std::vector<std::byte> chunk_;  // of the file, with gaps between the runs
    std::uint32_t block_first_ = 0;
    std::uint32_t block_count_ = 0;
};

void check_length(const InputFile& file, const VolumeInfo& info, const FlatLayout& layout) {
    const std::uint64_t needed = volume_bytes(file.path(), info.lattice.size, sample_bytes(layout.format));
    const std::uint64_t present = file.size() < layout.offset ? 0 : file.size() - layout.offset;
    if (present >= needed) return;
    const std::string text = "the file holds " + std::to_string(present) + " bytes of samples where its header says " +
                             std::to_string(needed) + "; it is truncated, fetch it again";
    if (layout.order[2] != 2) fail(file.path(), text);
    fail_section(file.path(), present / (needed / info.lattice.size[2]), text);
}

}  // namespace

std::unique_ptr<SectionReader> open_flat(InputFile file, VolumeInfo info, const FlatLayout& given,
                                         const ReadOptions& options) {
    FlatLayout layout = given;
    order_reals(options, layout.format, info);
    check_length(file, info, layout);
    apply_options(info, options);
    return std::make_unique<FlatReader>(std::move(file), std::move(info), layout);
}

}  // namespace regionmesh::formats
