#include "formats/chunked/hdf5_volume.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <numeric>
#include <utility>

#include "formats/array/block_reader.h"
#include "formats/array/strided_copy.h"
#include "formats/array/volume_size.h"
#include "formats/input_file.h"

namespace regionmesh::formats {
namespace {

using Triple = std::array<std::uint64_t, 3>;

constexpr std::uint64_t kBoxBytes = std::uint64_t{16} << 20;  // of one request, unless chunks are larger
constexpr std::uint64_t kCrossBytes = std::uint64_t{64}
                                      << 20;  // most bytes of sections across the order of the file, read together
constexpr std::uint64_t kCrossSections = 64;
constexpr std::uint64_t kMaxGrowth = std::uint64_t{1} << 15;  // of packed samples, whatever the filter

class Hdf5Source final : public BlockSource {
public:
    Hdf5Source(std::unique_ptr<Hdf5Reader> file, const Hdf5Volume& volume, ArrayAxes axes, const Triple& size,
               const Triple& chunk)
        : file_(std::move(file)),
          path_(volume.dataset.path),
          shape_(volume.dataset.shape),
          is_flat_(volume.flat_size.has_value()),
          axes_(std::move(axes)),
          size_(size),
          chunk_(chunk),
          bytes_(sample_bytes(format_of(volume.dataset).value())) {}

    void read(const Block& block, std::span<std::byte> samples) override {
        const auto [inner, outer, swept] = block.sweep.axes;
        const Triple step = box_size(block);
        Pitches pitch{};
        std::uint64_t next = bytes_;
        for (const int axis : block.sweep.axes) {
            pitch[axis] = next;
            next *= block.box.size()[axis];
        }
        const auto& [low, high] = block.box;
        Triple start{low[0], low[1], low[2]}, count{};
        count[swept] = high[swept] - low[swept];
        for (start[outer] = low[outer]; start[outer] < high[outer]; start[outer] += count[outer]) {
            for (start[inner] = low[inner]; start[inner] < high[inner]; start[inner] += count[inner]) {
                for (const int axis : {inner, outer})
                    count[axis] =
                        std::min<std::uint64_t>(step[axis] - start[axis] % chunk_[axis], high[axis] - start[axis]);
                std::byte* corner = samples.data() + (start[inner] - low[inner]) * pitch[inner] +
                                    (start[outer] - low[outer]) * pitch[outer];
                copy_from_file(start, count, {corner, pitch});
            }
        }
    }

private:
    /// Whole chunks across the sweep, as many as kBoxBytes allows, first along the axis that is faster in the file.
    Triple box_size(const Block& block) const {
        const int swept = block.sweep.axes[2];
        Triple step = chunk_;
        step[swept] = block.box.size()[swept];
        for (const int axis : fastest_first()) {
            if (axis == swept) continue;
            const std::uint64_t held = step[0] * step[1] * step[2] * bytes_;
            step[axis] = std::min(step[axis] * std::max<std::uint64_t>(1, kBoxBytes / held), size_[axis]);
        }
        return step;
    }

    std::array<int, 3> fastest_first() const {
        std::array<int, 3> order{0, 1, 2};
        std::ranges::stable_sort(order, [&](int a, int b) { return axes_.axis[a] > axes_.axis[b]; });
        return order;
    }

    void copy_from_file(const Triple& start, const Triple& count, Strided<std::byte> to) {
        Hdf5Box box{.start = axes_.index, .count = std::vector<std::uint64_t>(shape_.size(), 1)};
        Pitches pitch{};
        std::uint64_t first = 0;
        if (is_flat_) {  // reads whole planes and copies a part
            const std::uint64_t plane = size_[0] * size_[1];
            box.start[0] = start[2] * plane;
            box.count[0] = count[2] * plane;
            pitch = {bytes_, bytes_ * size_[0], bytes_ * plane};
            first = start[0] * pitch[0] + start[1] * pitch[1];
        } else {
            std::uint64_t next = bytes_;
            for (const int axis : fastest_first()) {
                if (axes_.axis[axis] < 0) continue;
                box.start[axes_.axis[axis]] = start[axis];
                box.count[axes_.axis[axis]] = count[axis];
                pitch[axis] = next;
                next *= count[axis];
            }
        }
        const std::uint64_t samples =
            std::accumulate(box.count.begin(), box.count.end(), std::uint64_t{1}, std::multiplies<>());
        const Bytes bytes = file_->read(path_, box);
        if (bytes.size() != samples * bytes_) fail(file_->path(), path_ + ": changed while it was read; start again");
        copy_box({bytes.data() + first, pitch}, to, count, bytes_);
    }

    std::unique_ptr<Hdf5Reader> file_;
    std::string path_;
    std::vector<std::uint64_t> shape_;
    bool is_flat_;
    ArrayAxes axes_;
    Triple size_, chunk_;
    std::uint64_t bytes_;
};

/// Samples that are best read together. A contiguous dataset is read in single sections along its slowest axis, in
/// groups of sections along the others.
Triple reading_chunk(const Hdf5Volume& volume, const ArrayAxes& axes, const std::array<std::uint32_t, 3>& size) {
    if (volume.flat_size) return {size[0], size[1], 1};
    Triple chunk = axes.along(volume.dataset.chunk.empty() ? std::vector<std::uint64_t>(axes.index.size(), 1)
                                                           : volume.dataset.chunk);
    if (volume.dataset.chunk.empty()) {
        const std::uint64_t volume_size =
            volume_bytes(volume.source, size, sample_bytes(format_of(volume.dataset).value()));
        for (const int axis : {0, 1})
            chunk[axis] = std::clamp<std::uint64_t>(kCrossBytes / (volume_size / size[axis]), 1, kCrossSections);
    }
    for (int axis = 0; axis < 3; ++axis) chunk[axis] = std::min<std::uint64_t>(chunk[axis], size[axis]);
    return chunk;
}

}  // namespace

std::optional<SampleFormat> format_of(const Hdf5Entry& dataset) {
    constexpr bool kIsBig = std::endian::native == std::endian::big;
    if (dataset.sample_type) return SampleFormat{*dataset.sample_type, kIsBig};
    if (dataset.type.starts_with("float")) return real_format(NumberType::kFloat64, kIsBig);
    return std::nullopt;
}

std::string describe(const Hdf5Entry& dataset) {
    std::string text = dataset.path + " (" + dataset.type;
    for (std::size_t axis = 0; axis < dataset.shape.size(); ++axis)
        text += (axis ? " x " : ", ") + std::to_string(dataset.shape[axis]);
    return text + ")";
}

std::string list_datasets(const std::filesystem::path& file, const std::vector<Hdf5Entry>& datasets) {
    constexpr std::size_t kShown = 8;
    std::string text;
    for (std::size_t i = 0; i < std::min(datasets.size(), kShown); ++i)
        text += (i ? ", " : "") + file.string() + ":" + describe(datasets[i]);
    if (datasets.size() > kShown) text += " and " + std::to_string(datasets.size() - kShown) + " more";
    return text;
}

void require_labels(const std::string& source, const Hdf5Entry& dataset) {
    if (!dataset.obstacle.empty()) fail(source, dataset.obstacle + "; write it again with gzip or uncompressed");
    const auto format = format_of(dataset);
    if (!format) fail(source, "samples are " + dataset.type + "; labels must be whole numbers");
    std::uint64_t bytes = sample_bytes(*format);
    for (const std::uint64_t size : dataset.chunk) {
        if (size == 0 || bytes > kMaxChunkBytes / size)
            fail(source, "a chunk holds more than a GiB; store it in smaller ones (h5repack)");
        bytes *= size;
    }
}

std::unique_ptr<SectionReader> open_hdf5_volume(std::unique_ptr<Hdf5Reader> file, const Hdf5Volume& volume,
                                                const ReadOptions& options) {
    const Hdf5Entry& dataset = volume.dataset;
    ArrayAxes axes;
    if (volume.flat_size) {
        axes.index.assign(dataset.shape.size(), 0);
    } else {
        axes = choose_axes(volume.source, dataset.shape, volume.axis_names, options);
    }
    const auto size = checked_size(volume.source, volume.flat_size ? *volume.flat_size : axes.along(dataset.shape));
    const SampleFormat format = format_of(dataset).value();
    VolumeInfo info = volume_info(volume.source, volume.format, format.type, size);
    place(info, volume.placement, options);
    info.layer_count = static_cast<std::uint32_t>(
        std::min<std::uint64_t>(axes.layer_count, std::numeric_limits<std::uint32_t>::max()));
    const std::uint64_t sample = sample_bytes(format);
    Triple chunk = reading_chunk(volume, axes, size);
    const bool is_backed = kMaxBlockBytes / kMaxGrowth <= dataset.stored_bytes;
    if (!is_backed && chunk[0] * chunk[1] * chunk[2] * sample > kMaxBareBytes) chunk = {1, 1, 1};
    const std::uint64_t box_bytes =
        std::min(std::max(kBoxBytes, chunk[0] * chunk[1] * chunk[2] * sample), volume_bytes(info.source, size, sample));
    const BlockLayout layout{.format = format,
                             .chunk = chunk,
                             .source_bytes = 3 * box_bytes,  // in this process, in the socket, and in regionmesh-hdf5
                             .is_backed = is_backed};
    auto source = std::make_unique<Hdf5Source>(std::move(file), volume, axes, Triple{size[0], size[1], size[2]}, chunk);
    return open_blocks(std::move(source), std::move(info), layout, axes.without_layer(options));
}

}  // namespace regionmesh::formats
