// The .npy format: https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html
#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "formats/array/array_axes.h"
#include "formats/array/array_file.h"
#include "formats/array/npy_array.h"
#include "formats/array/read_pipe.h"
#include "formats/array/volume_formats.h"
#include "formats/array/volume_size.h"
#include "formats/codec/deflate_stream.h"
#include "formats/text/json_text.h"

namespace regionmesh::formats {
namespace {

constexpr std::size_t kStartBytes = 12;  // magic, version, and the length of the header
constexpr std::size_t kMaxHeaderBytes = std::size_t{1} << 20;

struct NpyHeader {
    std::string descr;  // "<u2"
    bool is_fortran = false;
    std::vector<std::uint64_t> shape;
    std::uint64_t data_offset = 0;
};

/// The header is a Python dictionary of words, tuples, sizes (with L from Python 2) and truth values. As JSON it has
/// double quotes, brackets, small letters, and no comma before a closing bracket.
std::string to_json_text(std::string_view python) {
    std::string text;
    char quote = '\0';
    for (const char c : python) {
        const bool is_quote = quote ? c == quote : c == '\'' || c == '"';
        if (is_quote) quote = quote ? '\0' : c;
        if (quote || is_quote) {
            text += is_quote ? '"' : c;
            continue;
        }
        if (c == ')' || c == ']' || c == '}') {
            const std::size_t last = text.find_last_not_of(" \t\r\n");
            if (last != std::string::npos && text[last] == ',') text.resize(last);
        }
        if (c == 'L') continue;
        text += c == '(' ? '[' : c == ')' ? ']' : c == 'T' ? 't' : c == 'F' ? 'f' : c;
    }
    return text;
}

NpyHeader parse_header(const std::filesystem::path& path, std::string_view text) {
    const auto refuse = [&](const std::string& what) {
        fail(path, "the npy header is damaged (" + what + "); write the file again");
    };
    try {
        NpyHeader header;
        const nlohmann::json json = parse_json(path, to_json_text(text));
        for (const auto& [key, value] : json.items())
            if (key != "descr" && key != "fortran_order" && key != "shape") refuse("unknown key '" + key + "'");
        if (json.at("descr").is_array())
            fail(path, "samples are structures; labels must be integers: save one field alone");
        json.at("descr").get_to(header.descr);
        header.is_fortran = json.at("fortran_order").get<bool>();
        for (const auto& size : json.at("shape")) {
            if (!size.is_number_unsigned()) refuse("shape is not a tuple of sizes");
            header.shape.push_back(size.get<std::uint64_t>());
        }
        if (header.descr.empty()) refuse("descr is empty");
        return header;
    } catch (const nlohmann::json::exception& problem) {
        refuse(problem_text(problem));
    }
    return {};
}

/// Where the text of the header lies.
struct TextPlace {
    std::size_t begin, length;
};

/// `start` are the first bytes of the file, kStartBytes if it has as many.
TextPlace find_text(const std::filesystem::path& path, std::span<const std::byte> start) {
    const auto byte = [&](std::size_t i) { return std::to_integer<std::size_t>(start[i]); };
    const std::string_view magic(reinterpret_cast<const char*>(start.data()), std::min<std::size_t>(6, start.size()));
    if (start.size() < kStartBytes || magic != "\x93NUMPY")
        fail(path, "not an npy file (it does not begin as one); write it with numpy.save");
    const std::size_t version = byte(6);
    if (version < 1 || version > 3) fail(path, "npy version " + std::to_string(version) + "; versions 1 to 3 are read");
    const std::size_t length_bytes = version == 1 ? 2 : 4;
    std::size_t length = 0;
    for (std::size_t i = 0; i < length_bytes; ++i) length |= byte(8 + i) << (8 * i);
    return {8 + length_bytes, length};
}

/// Of the .npy file that begins at `begin`.
NpyHeader read_header(const InputFile& file, std::uint64_t begin) {
    std::array<std::byte, kStartBytes> start{};
    const std::size_t present = file.read(begin, start);
    const auto [offset, length] = find_text(file.path(), std::span(start).first(present));
    if (length > kMaxHeaderBytes || offset + length > file.size() - begin) {
        fail(file.path(), "the npy header says it takes " + std::to_string(length) + " bytes of a file of " +
                              std::to_string(file.size()) + "; the file is truncated, fetch it again");
    }
    std::string text(length, '\0');
    file.read(begin + offset, std::as_writable_bytes(std::span(text)));
    NpyHeader header = parse_header(file.path(), text);
    header.data_offset = begin + offset + length;
    return header;
}

SampleFormat parse_format(const std::filesystem::path& path, const std::string& descr) {
    const auto refuse = [&](const std::string& what) {
        fail(path, what + " (dtype '" + descr + "'); labels must be integers: save a.astype('int32')");
    };
    const bool has_order = !descr.empty() && std::string_view("<>|=").find(descr.front()) != std::string_view::npos;
    const std::string_view word = std::string_view(descr).substr(has_order ? 1 : 0);
    const char kind = word.empty() ? '?' : word.front();
    if (word == "f4" || word == "f8")
        return real_format(word == "f4" ? NumberType::kFloat32 : NumberType::kFloat64, descr.front() == '>');
    if (kind == 'f') refuse("samples are float");
    if (kind == 'c') refuse("samples are complex");
    SampleFormat format{.is_big_endian = descr.front() == '>'};
    if (word == "b1") {
        format.type = SampleType::kU1;
        return format;
    }
    const std::string size(word.substr(std::min<std::size_t>(1, word.size())));
    const std::string bits = size == "1" ? "8" : size == "2" ? "16" : size == "4" ? "32" : size == "8" ? "64" : "?";
    const auto type = parse_sample_type((kind == 'u' ? "uint" : kind == 'i' ? "int" : "?") + bits);
    if (!type) refuse("samples are not integers");
    format.type = *type;
    return format;
}

/// numpy's last index is x. One before z numbers volumes, and one behind x the values of a sample.
void set_shape(const NpyHeader& header, const ReadOptions& options, ArrayFile& array) {
    const std::size_t axis_count = header.shape.size();
    if (axis_count < 2 || axis_count > 4)
        fail(array.source, "the array has " + std::to_string(axis_count) + " dimensions; save one of shape (z, y, x)");
    const std::vector<std::string> names(axis_count);
    const ArrayAxes axes = choose_axes(array.source, header.shape, names, options);
    array.lattice.size = checked_size(array.source, axes.along(header.shape));
    if (!axes.has_layers) return;
    if (header.is_fortran) fail(array.source, "is in Fortran order; save numpy.ascontiguousarray(a)");
    const bool is_first = axes.axis[0] + 1 == static_cast<int>(axis_count);
    const std::size_t outer = is_first ? 0 : axis_count - 1;
    if (header.shape[outer] > kMostLayers) fail(array.source, "has more than 4096 volumes; save fewer in one file");
    (is_first ? array.blocks : array.components) = static_cast<std::uint32_t>(header.shape[outer]);
    (is_first ? array.block : array.component) = static_cast<std::uint32_t>(axes.index[outer]);
}

/// The header at the beginning of a stream; data_offset counts from there.
NpyHeader take_header(const std::filesystem::path& path, ByteStream& stream) {
    std::vector<std::byte> bytes(kStartBytes);
    bytes.resize(stream.read(bytes));
    const auto [offset, length] = find_text(path, bytes);
    if (length > kMaxHeaderBytes || offset + length < kStartBytes)
        fail(path, "the npy header says it takes " + std::to_string(length) + " bytes; write it with numpy.save");
    bytes.resize(offset + length);
    const auto rest = std::span(bytes).subspan(kStartBytes);
    if (stream.read(rest) < rest.size()) fail(path, stream.problem());
    NpyHeader header = parse_header(path, {reinterpret_cast<const char*>(bytes.data()) + offset, length});
    header.data_offset = offset + length;
    return header;
}

std::unique_ptr<SectionReader> open_with(const NpyHeader& header, ArrayFile array, const ReadOptions& options) {
    array.sample = parse_format(array.source, header.descr);
    set_shape(header, options, array);
    // In Fortran order the first index, z, runs fastest.
    if (header.is_fortran) array.order = {2, 1, 0};
    return open_array(array, options);
}

}  // namespace

StreamedHeader read_npy_header(const std::filesystem::path& path, ByteStream& stream) {
    const NpyHeader header = take_header(path, stream);
    if (header.is_fortran) fail(path, "is in Fortran order; send numpy.ascontiguousarray(a)");
    ArrayFile array{.source = path};
    set_shape(header, {}, array);
    return {array.lattice.size, parse_format(path, header.descr)};
}

std::unique_ptr<SectionReader> open_npy_in(const std::filesystem::path& path, std::uint64_t begin, bool is_deflated,
                                           const ReadOptions& options) {
    ArrayFile array{.format = "npy", .source = path, .remedy = "write it with numpy.savez, which does not compress"};
    if (!is_deflated) {
        const NpyHeader header = read_header(InputFile(path), begin);
        array.begin = header.data_offset;
        return open_with(header, std::move(array), options);
    }
    DeflateStream stream(std::make_unique<PlainStream>(InputFile(path), begin), /*is_bare=*/true);
    const NpyHeader header = take_header(path, stream);
    if (header.is_fortran) fail(path, "is in Fortran order; save numpy.ascontiguousarray(a)");
    array.encoding = Encoding::kDeflated;
    array.is_bare = true;
    array.begin = begin;
    array.skipped_bytes = static_cast<std::int64_t>(header.data_offset);
    return open_with(header, std::move(array), options);
}

std::unique_ptr<SectionReader> open_npy(const std::filesystem::path& path, const ReadOptions& options) {
    return open_npy_in(path, 0, false, options);
}

}  // namespace regionmesh::formats
