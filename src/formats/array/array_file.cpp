#include "formats/array/array_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <utility>

#include "base/add_warning.h"
#include "formats/array/flat_reader.h"
#include "formats/array/stream_reader.h"
#include "formats/array/volume_size.h"
#include "formats/codec/deflate_stream.h"
#include "formats/text/ascii_stream.h"
#include "formats/text/header_text.h"
#include "regionmesh/label_names_file.h"

namespace regionmesh::formats {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostFiles = 1'000'000;

/// The place after the lines to skip.
std::uint64_t after_lines(const InputFile& file, std::uint64_t place, std::uint64_t lines) {
    std::array<char, 4096> text;
    while (lines > 0) {
        const std::size_t count = file.read(place, std::as_writable_bytes(std::span(text)));
        if (count == 0) fail(file.path(), fmt::format("ends {} lines before its samples; check the line skip", lines));
        for (std::size_t i = 0; i < count && lines > 0; ++i, ++place) lines -= text[i] == '\n';
    }
    return place;
}

/// Where the samples of one file begin; in a deflated file, where the stream begins.
std::uint64_t samples_begin(const ArrayFile& array, const InputFile& file, std::uint64_t needed) {
    const std::uint64_t begin = after_lines(file, array.begin, array.skipped_lines);
    if (array.encoding == Encoding::kDeflated) return begin;
    const std::uint64_t present = file.size() - std::min(begin, file.size());
    if (array.skipped_bytes >= 0) return begin + std::min<std::uint64_t>(array.skipped_bytes, present);
    if (array.encoding == Encoding::kAscii) fail(file.path(), "samples as text cannot be found from its end");
    return begin + (present < needed ? 0 : present - needed);
}

void check_present(const ArrayFile& array, const InputFile& file, std::uint64_t begin, std::uint64_t needed) {
    const std::uint64_t present = file.size() - std::min(begin, file.size());
    if (array.encoding == Encoding::kDeflated) {
        check_inflated(file.path(), present, needed);
        check_inflated(file.path(), present, static_cast<std::uint64_t>(array.skipped_bytes));
        return;
    }
    const bool is_ascii = array.encoding == Encoding::kAscii;
    const std::uint64_t most = is_ascii ? most_ascii_samples(present) : present;
    if (most >= (is_ascii ? needed / kAsciiBytes : needed)) return;
    fail(file.path(), fmt::format("has {} bytes of samples, fewer than the header says; {}", present,
                                  array.files.size() > 1 ? "it is truncated, or the header names too few files"
                                                         : "it is truncated, fetch it again"));
}

StreamPart part_of(const ArrayFile& array, const fs::path& path, std::uint64_t needed) {
    const InputFile file(path);
    const std::uint64_t begin = samples_begin(array, file, needed);
    check_present(array, file, begin, needed);
    return {[path, begin, needed, encoding = array.encoding, sample = array.sample, end = array.end,
             is_bare = array.is_bare, skip = array.skipped_bytes]() -> std::unique_ptr<ByteStream> {
                if (encoding == Encoding::kRaw) return std::make_unique<PlainStream>(InputFile(path), begin);
                if (encoding == Encoding::kAscii)
                    return std::make_unique<AsciiStream>(InputFile(path), sample, needed / kAsciiBytes, begin, end);
                auto stream =
                    std::make_unique<DeflateStream>(std::make_unique<PlainStream>(InputFile(path), begin), is_bare);
                stream->skip(static_cast<std::uint64_t>(skip));  // if it cannot, the first read reports why
                return stream;
            },
            needed};
}

struct Pattern {
    std::string_view before, after;
    std::size_t width = 0;
    bool has_zeros = false;
};

std::optional<Pattern> parse_pattern(std::string_view text) {
    const std::size_t percent = text.find('%');
    if (percent == std::string_view::npos) return std::nullopt;
    Pattern pattern{text.substr(0, percent), text.substr(percent + 1)};
    std::string_view& rest = pattern.after;
    if (rest.starts_with('0')) pattern.has_zeros = true;
    for (; !rest.empty() && rest[0] >= '0' && rest[0] <= '9' && pattern.width < 100; rest.remove_prefix(1))
        pattern.width = 10 * pattern.width + static_cast<std::size_t>(rest[0] - '0');
    if (rest.empty() || (rest[0] != 'd' && rest[0] != 'i' && rest[0] != 'u')) return std::nullopt;
    rest.remove_prefix(1);
    if (pattern.width >= 100 || rest.find('%') != std::string_view::npos) return std::nullopt;
    return pattern;
}

void require_present(const fs::path& header, const fs::path& file) {
    std::error_code error;
    if (!fs::exists(file, error) && !error)
        fail(file, "no such file; put it there, or correct its name in the header, " + header.string() +
                       (file.filename().string().find('%') != std::string::npos
                            ? "; a pattern has one number, as in 'z%03d.raw 1 10 1'"
                            : ""));
}

/// A header from somewhere must not make the program read any file of this machine.
void require_files_within(const ArrayFile& array) {
    for (const fs::path& file : array.files) {
        fs::path folder = array.source.parent_path();
        if (folder.empty()) folder = ".";
        if (file.is_absolute()) folder = fs::absolute(folder);
        const fs::path inside = file.lexically_normal().lexically_relative(folder.lexically_normal());
        if (inside.empty() || *inside.begin() == "..")
            fail(array.source, "names " + shown(file.string()) +
                                   ", a file outside its folder; give --external-files if you trust the header");
    }
}

}  // namespace

void take_table_beside(ArrayFile& array) {
    NamesAndColours table = table_beside(array.source);
    array.names = std::move(table.names);
    array.colours = std::move(table.colours);
    add_warning(array.warning, table.warning);
}

void choose_block(const std::vector<BlockAxis>& axes, const ReadOptions& options, ArrayFile& array) {
    constexpr std::uint64_t kMostBlocks = std::uint64_t{1} << 31;
    const auto several = std::ranges::count_if(axes, [](const BlockAxis& axis) { return axis.size > 1; });
    std::uint64_t blocks = 1, block = 0;
    for (const BlockAxis& axis : axes) {
        if (axis.size == 0) fail(array.source, axis.name + " is 0; give a file with samples");
        if (axis.size > kMostBlocks / blocks) fail(array.source, "holds more than 2^31 volumes; check the header");
        if (axis.size == 1) continue;
        if (several > 1)
            fail(array.source, fmt::format("holds volumes along several axes ({} of {}); save those along one of them",
                                           axis.size, axis.name));
        if (!options.layer)
            fail(array.source, fmt::format("holds {} volumes ({}); choose one with --layer 0 to {}", axis.size,
                                           axis.name, axis.size - 1));
        if (*options.layer >= axis.size)
            fail(array.source,
                 fmt::format("holds volumes 0 to {} ({}); there is no {}", axis.size - 1, axis.name, *options.layer));
        block += *options.layer * blocks;
        blocks *= axis.size;
    }
    array.blocks = static_cast<std::uint32_t>(blocks);
    array.block = static_cast<std::uint32_t>(block);
}

std::unique_ptr<SectionReader> open_array(const ArrayFile& array, const ReadOptions& given) {
    const bool has_chosen = array.blocks > 1 || array.components > 1;
    const ReadOptions options = has_chosen ? without_choice(given) : given;
    const std::vector<fs::path> files = array.files.empty() ? std::vector{array.source} : array.files;
    if (!options.external_files) require_files_within(array);
    for (const fs::path& file : array.files) require_present(array.source, file);
    SampleFormat format = array.sample;
    if (array.encoding == Encoding::kAscii) format = ascii_format(array.sample);
    const auto& size = array.lattice.size;
    const std::uint64_t sample = sample_bytes(format) * array.components;
    const std::uint64_t volume = volume_bytes(array.source, size, sample);
    if (volume > std::numeric_limits<std::int64_t>::max() / array.blocks)
        fail(array.source, "describes more samples than any file holds; check the header");
    const std::uint64_t all = volume * array.blocks;
    if (array.encoding == Encoding::kDeflated && array.skipped_bytes < 0)
        fail(array.source, "compressed samples cannot be found from the end of the file; give the bytes to skip");
    if (all / sample % files.size() != 0) {
        fail(array.source, fmt::format("names {} files for {} samples; each must hold the same number", files.size(),
                                       size_text({size[0], size[1], size[2]})));
    }
    VolumeInfo info = volume_info(array.source, array.format, label_type(array.sample), size);
    info.lattice = array.lattice;
    info.space = array.space;
    info.metres = array.metres;
    info.names = array.names;
    info.colours = array.colours;
    info.warning = array.warning;
    info.files = array.files;
    info.layer_count = std::max(array.blocks, array.components);
    if (array.encoding == Encoding::kRaw && files.size() == 1 && array.components == 1) {
        if (array.can_sweep_all) info.can_sweep = {true, true, true};
        InputFile file(files[0]);
        const std::uint64_t offset = samples_begin(array, file, all) + array.block * volume;
        return open_flat(std::move(file), std::move(info), {.offset = offset, .format = format, .order = array.order},
                         options);
    }
    std::vector<StreamPart> parts;
    for (const fs::path& file : files) parts.push_back(part_of(array, file, all / files.size()));
    const StreamLayout layout{
        .offset = array.block * volume, .format = format, .components = array.components, .component = array.component};
    return open_stream(std::make_unique<JoinedStream>(std::move(parts)), std::move(info), layout, options,
                       std::string("give --sweep z, or ") + array.remedy);
}

std::unique_ptr<ByteStream> open_inflated(const fs::path& path, Encoding& encoding) {
    InputFile file(path);
    if (!is_gzipped(file)) return std::make_unique<PlainStream>(std::move(file));
    encoding = Encoding::kDeflated;
    return std::make_unique<DeflateStream>(std::move(file));
}

std::vector<std::byte> read_header(const fs::path& path, Encoding& encoding, std::size_t least, std::size_t most) {
    const auto stream = open_inflated(path, encoding);
    std::vector<std::byte> bytes(most);
    bytes.resize(stream->read(bytes));
    if (encoding == Encoding::kDeflated && bytes.size() < least) fail(path, stream->problem());
    return bytes;
}

fs::path file_beside(const fs::path& header, std::string_view name) { return header.parent_path() / name; }

std::vector<fs::path> listed_files(const fs::path& header, std::string_view text) {
    std::vector<fs::path> files;
    while (!text.empty()) {
        const std::string_view name = trim(take_line(text));
        if (!name.empty()) files.push_back(file_beside(header, name));
        if (files.size() > kMostFiles) fail(header, "lists more than a million files of samples; check the header");
    }
    if (files.empty()) fail(header, "lists no files of samples; name them below");
    return files;
}

bool is_pattern(std::string_view text) { return parse_pattern(text).has_value(); }

std::vector<fs::path> numbered_files(const fs::path& header, std::string_view text,
                                     std::optional<std::uint32_t> count) {
    const auto refuse = [&](const char* what) {
        fail(header, fmt::format("the file pattern '{}' {}; write one such as 'z%03d.raw 1 10 1'", shown(text), what));
    };
    const auto words = split_words(text);
    const auto pattern = parse_pattern(words.empty() ? text : words[0]);
    std::array<std::int64_t, 3> numbers{1, 0, 1};  // first, last, step
    if (!pattern || (words.size() < 3 && !count)) refuse("has no number to fill in, or no first and last one");
    for (std::size_t i = 0; i < std::min<std::size_t>(3, words.size() - 1); ++i) {
        const auto number = parse_integer(words[i + 1]);
        if (!number || *number < -1'000'000'000'000 || *number > 1'000'000'000'000)
            refuse("has something that is no number");
        numbers[i] = *number;
    }
    if (words.size() < 3) numbers[1] = numbers[0] + *count - 1;
    const auto [first, last, step] = numbers;
    if (step == 0 || (step > 0 ? last < first : last > first)) refuse("never comes to its last number");
    if (static_cast<std::uint64_t>((last - first) / step) >= kMostFiles) refuse("stands for more than a million files");
    std::vector<fs::path> files;
    for (std::int64_t number = first; step > 0 ? number <= last : number >= last; number += step) {
        const std::string digits = pattern->has_zeros ? fmt::format("{:0{}}", number, pattern->width)
                                                      : fmt::format("{:{}}", number, pattern->width);
        files.push_back(file_beside(header, std::string(pattern->before) + digits + std::string(pattern->after)));
    }
    return files;
}

}  // namespace regionmesh::formats
