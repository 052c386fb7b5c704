// The .npy format: https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html
#include <algorithm>
#include <cctype>
#include <charconv>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "formats/array/flat_reader.h"
#include "formats/array/volume_formats.h"
#include "formats/array/volume_size.h"

namespace regionmesh::formats {
namespace {

constexpr std::size_t kMaxHeaderBytes = std::size_t{1} << 20;

struct NpyHeader {
    std::string descr;  // "<u2"
    bool is_fortran = false;
    std::vector<std::uint64_t> shape;
    std::uint64_t data_offset = 0;
};

/// The header is a Python dictionary with three keys, in any order. What is left of it is `text_`.
class NpyHeaderParser {
public:
    NpyHeaderParser(const std::filesystem::path& path, std::string_view text) : path_(path), text_(text) {}

    NpyHeader parse() {
        NpyHeader header;
        bool has_order = false, has_shape = false;
        expect('{');
        while (!accept('}')) {
            const std::string key = parse_string();
            expect(':');
            if (key == "descr") {
                if (peek() == '[') fail(path_, "samples are structures; labels must be integers: save one field alone");
                header.descr = parse_string();
            } else if (key == "fortran_order") {
                header.is_fortran = parse_bool();
                has_order = true;
            } else if (key == "shape") {
                header.shape = parse_shape();
                has_shape = true;
            } else {
                refuse("unknown key '" + key + "'");
            }
            if (!accept(',') && peek() != '}') refuse("no comma or brace after '" + key + "'");
        }
        if (header.descr.empty() || !has_order || !has_shape) refuse("descr, fortran_order or shape is missing");
        return header;
    }

private:
    [[noreturn]] void refuse(const std::string& what) const {
        fail(path_, "the npy header is damaged (" + what + "); write the file again");
    }
    char peek() {
        while (!text_.empty() && std::isspace(static_cast<unsigned char>(text_.front()))) text_.remove_prefix(1);
        return text_.empty() ? '\0' : text_.front();
    }
    bool accept(char wanted) {
        if (peek() != wanted) return false;
        text_.remove_prefix(1);
        return true;
    }
    void expect(char wanted) {
        if (!accept(wanted)) refuse(std::string("no '") + wanted + "'");
    }
    std::string parse_string() {
        const char quote = peek();
        if (quote != '\'' && quote != '"') refuse("no quoted word");
        const std::size_t end = text_.find(quote, 1);
        if (end == std::string_view::npos) refuse("a quote is not closed");
        const std::string word(text_.substr(1, end - 1));
        text_.remove_prefix(end + 1);
        return word;
    }
    bool parse_bool() {
        peek();
        for (const std::string_view word : {"True", "False"}) {
            if (!text_.starts_with(word)) continue;
            text_.remove_prefix(word.size());
            return word == "True";
        }
        refuse("fortran_order is neither True nor False");
    }
    std::vector<std::uint64_t> parse_shape() {
        std::vector<std::uint64_t> shape;
        expect('(');
        while (!accept(')')) {
            peek();
            std::uint64_t size = 0;
            const auto [end, error] = std::from_chars(text_.data(), text_.data() + text_.size(), size);
            if (error != std::errc()) refuse("shape is not a tuple of sizes");
            text_.remove_prefix(static_cast<std::size_t>(end - text_.data()));
            accept('L');  // written by Python 2
            shape.push_back(size);
            if (!accept(',') && peek() != ')') refuse("shape is not a tuple of sizes");
        }
        return shape;
    }

    const std::filesystem::path& path_;
    std::string_view text_;
};

NpyHeader read_header(const InputFile& file) {
    std::array<std::byte, 12> start{};
    const std::size_t present = file.read(0, start);
    const auto byte = [&](std::size_t i) { return std::to_integer<std::size_t>(start[i]); };
    const std::string_view magic(reinterpret_cast<const char*>(start.data()), 6);
    if (present < start.size() || magic != "\x93NUMPY") {
        fail(file.path(), "not an npy file (it does not begin as one); write it with numpy.save");
    }
    const std::size_t version = byte(6);
    if (version < 1 || version > 3)
        fail(file.path(), "npy version " + std::to_string(version) + "; versions 1 to 3 are read");
    const std::size_t length_bytes = version == 1 ? 2 : 4;
    std::size_t length = 0;
    for (std::size_t i = 0; i < length_bytes; ++i) length |= byte(8 + i) << (8 * i);
    const std::uint64_t offset = 8 + length_bytes;
    if (length > kMaxHeaderBytes || offset + length > file.size()) {
        fail(file.path(), "the npy header says it takes " + std::to_string(length) + " bytes of a file of " +
                              std::to_string(file.size()) + "; the file is truncated, fetch it again");
    }
    std::string text(length, '\0');
    file.read(offset, std::as_writable_bytes(std::span(text)));
    NpyHeader header = NpyHeaderParser(file.path(), text).parse();
    header.data_offset = offset + length;
    return header;
}

SampleFormat parse_format(const std::filesystem::path& path, const std::string& descr) {
    const auto refuse = [&](const std::string& what) {
        fail(path, what + " (dtype '" + descr + "'); labels must be integers: save a.astype('int32')");
    };
    const bool has_order = !descr.empty() && std::string_view("<>|=").find(descr.front()) != std::string_view::npos;
    const std::string_view word = std::string_view(descr).substr(has_order ? 1 : 0);
    const char kind = word.empty() ? '?' : word.front();
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

}  // namespace

std::unique_ptr<SectionReader> open_npy(const std::filesystem::path& path, const ReadOptions& options) {
    InputFile file(path);
    NpyHeader header = read_header(file);
    const SampleFormat format = parse_format(path, header.descr);
    if (header.shape.size() != 2 && header.shape.size() != 3) {
        fail(path, "the array has " + std::to_string(header.shape.size()) + " dimensions; save one of shape (z, y, x)");
    }
    // numpy's last index is x; in Fortran order the first index, z, runs fastest.
    if (header.shape.size() == 2) header.shape.insert(header.shape.begin(), 1);
    const auto size = checked_size(path, {header.shape[2], header.shape[1], header.shape[0]});
    VolumeInfo info = volume_info(path, "npy", format.type, size);
    info.can_sweep = {true, true, true};
    const FlatLayout layout{.offset = header.data_offset,
                            .format = format,
                            .order = header.is_fortran ? std::array{2, 1, 0} : std::array{0, 1, 2}};
    return open_flat(std::move(file), std::move(info), layout, options);
}

}  // namespace regionmesh::formats
