#include "formats/chunked/store_array.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>
#include <numeric>
#include <utility>

#include "formats/array/block_reader.h"
#include "formats/array/strided_copy.h"
#include "formats/array/volume_size.h"
#include "formats/codec/numbers.h"
#include "formats/input_file.h"

namespace regionmesh::formats {
namespace {

namespace fs = std::filesystem;
using Indices = std::vector<std::uint64_t>;

constexpr std::size_t kMaxAxes = 16;
constexpr std::uint64_t kMaxChunks = std::uint64_t{1} << 22;    // of one block
constexpr std::uint64_t kMaxOverhead = std::uint64_t{1} << 20;  // of a codec, for a small chunk
constexpr std::uint64_t kMissing = ~std::uint64_t{0};           // offset and length of a missing chunk in a shard

/// Part of an array: from `low` up to, not including, `high`.
struct Range {
    Indices low, high;

    std::uint64_t count() const {
        std::uint64_t all = 1;
        for (std::size_t axis = 0; axis < low.size(); ++axis) all *= high[axis] - low[axis];
        return all;
    }
};

std::uint64_t product(const Indices& sizes) {
    return std::accumulate(sizes.begin(), sizes.end(), std::uint64_t{1}, std::multiplies<>());
}

/// The cells of a grid with cells of `size` that the range touches.
Range cells_of(const Range& range, const Indices& size) {
    Range cells = range;
    for (std::size_t axis = 0; axis < size.size(); ++axis) {
        cells.low[axis] = range.low[axis] / size[axis];
        cells.high[axis] = (range.high[axis] - 1) / size[axis] + 1;
    }
    return cells;
}

Range intersect(const Range& a, const Range& b) {
    Range common = a;
    for (std::size_t axis = 0; axis < a.low.size(); ++axis) {
        common.low[axis] = std::max(a.low[axis], b.low[axis]);
        common.high[axis] = std::min(a.high[axis], b.high[axis]);
    }
    return common;
}

Range cell_range(const Indices& cell, const Indices& size) {
    Range range{cell, cell};
    for (std::size_t axis = 0; axis < cell.size(); ++axis) {
        range.low[axis] = cell[axis] * size[axis];
        range.high[axis] = range.low[axis] + size[axis];
    }
    return range;
}

/// Calls visit with every index of the range, the last axis fastest. Requires that none of its sides is empty.
template <class Visit>
void for_each_index(const Range& range, Visit&& visit) {
    Indices index = range.low;
    for (;;) {
        visit(index);
        std::size_t axis = index.size();
        while (axis > 0 && ++index[axis - 1] == range.high[axis - 1]) {
            index[axis - 1] = range.low[axis - 1];
            --axis;
        }
        if (axis == 0) return;
    }
}

class ChunkSource final : public BlockSource {
public:
    ChunkSource(StoreArray array, ArrayAxes axes)
        : array_(std::move(array)), axes_(std::move(axes)), bytes_(sample_bytes(array_.format)) {}

    void read(const Block& block, std::span<std::byte> samples) override {
        wanted_ = {axes_.index, axes_.index};
        for (std::uint64_t& end : wanted_.high) ++end;
        std::uint64_t pitch = bytes_;
        for (const int axis : block.sweep.axes) {
            pitch_[axis] = pitch;
            pitch *= block.box.size()[axis];
            if (axes_.axis[axis] < 0) continue;
            wanted_.low[axes_.axis[axis]] = block.box.low[axis];
            wanted_.high[axes_.axis[axis]] = block.box.high[axis];
        }
        samples_ = samples.data();
        section_ = block.first();
        const std::uint64_t chunks = cells_of(wanted_, array_.chunk).count();
        if (chunks > kMaxChunks) {
            fail_section(array_.folder, section_,
                         std::to_string(chunks) + " chunks lie side by side; store it in larger ones");
        }
        for_each_index(cells_of(wanted_, array_.file), [&](const Indices& file) { read_file(file); });
    }

private:
    [[noreturn]] void refuse(const std::string& problem) const {
        fail_section(path_, section_, problem + "; the chunk is damaged, fetch it again");
    }

    fs::path path_of(const Indices& file) const {
        std::string name = array_.names.prefix;
        for (std::size_t i = 0; i < file.size(); ++i) {
            if (i > 0) name += array_.names.separator;
            name += std::to_string(file[array_.names.is_reversed ? file.size() - 1 - i : i]);
        }
        return array_.folder / name;
    }

    void read_file(const Indices& cell) {
        path_ = path_of(cell);
        std::error_code ignored;
        if (fs::status(path_, ignored).type() == fs::file_type::not_found)
            return fill(intersect(wanted_, cell_range(cell, array_.file)));
        const InputFile file(path_);
        if (array_.is_sharded) return read_shard(file, cell);
        load_chunk(file, 0, file.size());
        put_chunk(cell);
    }

    void load_chunk(const InputFile& file, std::uint64_t offset, std::uint64_t length) {
        const std::uint64_t most = product(array_.chunk) * bytes_;
        if (length > most + most / 4 + kMaxOverhead)
            refuse(std::to_string(length) + " bytes are too many for a chunk of " + std::to_string(most));
        fetch(file, offset, length);
    }

    /// The index holds offset and length of each chunk; the last axis runs fastest.
    void read_shard(const InputFile& file, const Indices& cell) {
        const Range inside = cell_range(cell, array_.file);
        Indices counts = array_.file;
        for (std::size_t axis = 0; axis < counts.size(); ++axis) counts[axis] /= array_.chunk[axis];
        const std::uint64_t index_bytes = product(counts) * 16 + 4 * array_.index_codecs.size();
        if (index_bytes > file.size()) refuse("the shard is shorter than its index");
        std::vector<std::byte> index(product(counts) * 16);
        fetch(file, array_.index_is_first ? 0 : file.size() - index_bytes, index_bytes);
        if (const std::string problem = unpack(packed_, array_.index_codecs, index); !problem.empty())
            refuse("the index of the shard: " + problem);
        for_each_index(cells_of(intersect(wanted_, inside), array_.chunk), [&](const Indices& chunk) {
            std::uint64_t place = 0;
            for (std::size_t axis = 0; axis < chunk.size(); ++axis)
                place = place * counts[axis] + chunk[axis] - cell[axis] * counts[axis];
            const std::uint64_t offset = load<std::uint64_t>(&index[place * 16], false);
            const std::uint64_t length = load<std::uint64_t>(&index[place * 16 + 8], false);
            if (offset == kMissing && length == kMissing)
                return fill(intersect(wanted_, cell_range(chunk, array_.chunk)));
            if (offset > file.size() || length > file.size() - offset)
                refuse("a chunk lies beyond the end of the shard");
            load_chunk(file, offset, length);
            put_chunk(chunk);
        });
    }

    void fetch(const InputFile& file, std::uint64_t offset, std::uint64_t length) {
        packed_.resize(length);
        if (file.read(offset, packed_) < length) refuse("the file became shorter while it was read");
    }

    /// Unpacks packed_ and copies the wanted samples.
    void put_chunk(const Indices& chunk) {
        std::span<const std::byte> packed = packed_;
        Indices size = array_.chunk;
        if (array_.has_head) take_head(packed, size);
        const std::uint64_t bytes = product(size) * bytes_;
        if (!may_hold(packed.size(), array_.codecs, bytes))
            refuse(std::to_string(packed.size()) + " bytes cannot hold the " + std::to_string(bytes) + " of a chunk");
        unpacked_.resize(bytes);
        if (const std::string problem = unpack(packed, array_.codecs, unpacked_); !problem.empty()) refuse(problem);
        const Range nominal = cell_range(chunk, array_.chunk);
        Range there = nominal;
        for (std::size_t axis = 0; axis < size.size(); ++axis) there.high[axis] = there.low[axis] + size[axis];
        const Range part = intersect(wanted_, there);
        if (size != array_.chunk) fill(intersect(wanted_, nominal));
        for (std::size_t axis = 0; axis < size.size(); ++axis) {
            if (part.low[axis] >= part.high[axis]) return;
        }
        Indices pitch(size.size());
        std::uint64_t next = bytes_, first = 0;
        for (auto axis = array_.stored.rbegin(); axis != array_.stored.rend(); ++axis) {
            pitch[*axis] = next;
            next *= size[*axis];
            first += pitch[*axis] * (part.low[*axis] - there.low[*axis]);
        }
        copy({unpacked_.data() + first, axes_.along(pitch, 0)}, part);
    }

    /// N5: a mode, the number of axes and the sizes along them, fastest first, as big-endian numbers.
    void take_head(std::span<const std::byte>& packed, Indices& size) const {
        const std::size_t axes = size.size();
        std::size_t length = 4 + 4 * axes;
        if (packed.size() < length) refuse("it is shorter than its head");
        const std::uint64_t mode = load<std::uint16_t>(packed.data(), true);
        if (mode > 1 || load<std::uint16_t>(&packed[2], true) != axes)
            refuse("its head is not one of a block of samples");
        for (std::size_t axis = 0; axis < axes; ++axis) {
            const std::uint64_t samples = load<std::uint32_t>(&packed[4 + 4 * axis], true);
            if (samples == 0 || samples > size[axes - 1 - axis]) refuse("its head claims another size");
            size[axes - 1 - axis] = samples;
        }
        if (mode == 1) {
            length += 4;
            if (packed.size() < length || load<std::uint32_t>(&packed[length - 4], true) != product(size))
                refuse("it holds another number of samples than its head says");
        }
        packed = packed.subspan(length);
    }

    void fill(const Range& part) { copy({array_.fill.data(), {0, 0, 0}}, part); }

    void copy(Strided<const std::byte> from, const Range& part) {
        Indices count(part.low.size());
        std::byte* to = samples_;
        for (std::size_t axis = 0; axis < count.size(); ++axis) count[axis] = part.high[axis] - part.low[axis];
        for (int axis = 0; axis < 3; ++axis) {
            if (axes_.axis[axis] >= 0)
                to += pitch_[axis] * (part.low[axes_.axis[axis]] - wanted_.low[axes_.axis[axis]]);
        }
        copy_box(from, {to, pitch_}, axes_.along(count), bytes_);
    }

    StoreArray array_;
    ArrayAxes axes_;
    std::size_t bytes_;  // of a sample
    std::vector<std::byte> packed_, unpacked_;
    // The block that is being read, its target, and the current file.
    Range wanted_;
    Pitches pitch_{};
    std::byte* samples_ = nullptr;
    std::uint64_t section_ = 0;
    fs::path path_;
};

/// Most bytes of a block that is as deep as a chunk, over the three axes.
std::uint64_t deepest_block(const StoreArray& array, const ArrayAxes& axes) {
    const auto size = axes.along(array.shape), chunk = axes.along(array.chunk);
    std::uint64_t most = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const std::uint64_t section = size[(axis + 1) % 3] * size[(axis + 2) % 3];
        const std::uint64_t bytes = std::min(chunk[axis], size[axis]) * sample_bytes(array.format);
        most = std::max(most, section > kMaxBlockBytes / bytes ? kMaxBlockBytes : section * bytes);
    }
    return most;
}

/// Does a file, named from the folder of the array, hold a chunk?
bool is_chunk(const StoreArray& array, std::string_view name) {
    if (!name.starts_with(array.names.prefix)) return false;
    name.remove_prefix(array.names.prefix.size());
    for (std::size_t axis = 0; axis < array.shape.size(); ++axis) {
        if (axis > 0 && !name.starts_with(array.names.separator)) return false;
        if (axis > 0) name.remove_prefix(1);
        const std::size_t digits = std::min(name.find_first_not_of("0123456789"), name.size());
        if (digits == 0) return false;
        name.remove_prefix(digits);
    }
    return name.empty();
}

/// Whether the chunk files may unpack to `wanted` bytes, judged by their sizes; stops at the first file that suffices.
/// Throws if there is no chunk: a folder of metadata alone was not fetched completely, or is the wrong one.
bool may_be_filled(const StoreArray& array, std::uint64_t wanted) {
    std::error_code error;
    std::uint64_t bytes = 0, files = 0;
    for (fs::recursive_directory_iterator entry(array.folder, error);
         !error && entry != fs::recursive_directory_iterator(); entry.increment(error)) {
        std::error_code ignored;
        if (!is_chunk(array, entry->path().lexically_relative(array.folder).generic_string())) continue;
        if (!entry->is_regular_file(ignored)) continue;
        bytes += entry->file_size(ignored);
        ++files;
        if (may_hold(bytes, array.codecs, wanted) || files == kMaxChunks) return true;
    }
    if (error) fail(array.folder, "the folder cannot be read: " + error.message());
    if (files == 0)
        fail(array.folder, "holds no chunk of samples under the names that its metadata give; fetch the store again");
    return false;
}

}  // namespace

void check_array(const StoreArray& array, const fs::path& metadata) {
    const std::size_t axes = array.shape.size();
    if (axes == 0 || axes > kMaxAxes)
        fail(metadata, "the array has " + std::to_string(axes) + " dimensions; 2 or 3 are read");
    if (array.chunk.size() != axes || array.file.size() != axes || array.stored.size() != axes)
        fail(metadata, "chunks have another number of dimensions than the array; write the file again");
    std::uint64_t bytes = sample_bytes(array.format), in_shard = 1;
    for (std::size_t axis = 0; axis < axes; ++axis) {
        const std::uint64_t chunk = array.chunk[axis], file = array.file[axis];
        if (std::ranges::count(array.stored, static_cast<int>(axis)) != 1)
            fail(metadata, "the order of axes in a chunk is none; write the file again");
        if (chunk == 0 || bytes > kMaxChunkBytes / chunk)
            fail(metadata, "a chunk is empty or holds more than a GiB; store it in smaller ones");
        if (file % chunk != 0 || file == 0 || file > kMaxAxisSamples)
            fail(metadata, "shards are not made of whole chunks; write the file again");
        bytes *= chunk;
        if (file / chunk > kMaxChunks / in_shard) fail(metadata, "a shard holds too many chunks; store fewer in one");
        in_shard *= file / chunk;
    }
}

std::unique_ptr<SectionReader> open_store_array(StoreArray array, StoreVolume volume, const ReadOptions& options) {
    const auto size = checked_size(array.folder, volume.axes.along(array.shape));
    const std::uint64_t deepest = deepest_block(array, volume.axes);
    const bool is_backed = may_be_filled(array, deepest > kMaxBareBytes ? deepest : 0);
    VolumeInfo info = volume_info(volume.source, volume.format, label_type(array.format), size);
    place(info, volume.placement, options);
    info.layer_count = static_cast<std::uint32_t>(
        std::min<std::uint64_t>(volume.axes.layer_count, std::numeric_limits<std::uint32_t>::max()));
    info.names = std::move(volume.names);
    info.colours = std::move(volume.colours);
    info.files = std::move(volume.files);
    const BlockLayout layout{.format = array.format,
                             .chunk = volume.axes.along(array.chunk),
                             .source_bytes = 2 * product(array.chunk) * sample_bytes(array.format),
                             .is_backed = is_backed};
    const ReadOptions rest = volume.axes.without_layer(options);
    auto source = std::make_unique<ChunkSource>(std::move(array), std::move(volume.axes));
    return open_blocks(std::move(source), std::move(info), layout, rest);
}

SampleFormat format_of(const fs::path& metadata, const std::string& word, bool is_big_endian) {
    if (word == "float32" || word == "float64")
        return real_format(word == "float32" ? NumberType::kFloat32 : NumberType::kFloat64, is_big_endian);
    if (const auto type = parse_sample_type(word)) return {*type, is_big_endian};
    fail(metadata, "samples are '" + word + "'; labels must be whole numbers");
}

void refuse_codec(const fs::path& metadata, const std::string& name) {
    fail(metadata, "chunks are made by '" + name +
                       "', which is not read; write it again with zstd, gzip, zlib, lz4, blosc or uncompressed");
}

}  // namespace regionmesh::formats
