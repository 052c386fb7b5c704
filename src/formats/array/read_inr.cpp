// The INRIMAGE-4 format of INRIA, which CGAL reads: a text header, most often of 256 bytes, then bare samples.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "formats/array/flat_reader.h"
#include "formats/array/stream_reader.h"
#include "formats/array/volume_formats.h"
#include "formats/array/volume_size.h"
#include "formats/codec/deflate_stream.h"
#include "formats/text/header_text.h"
#include "regionmesh/label_names_file.h"

namespace regionmesh::formats {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kBlockBytes = 256;
constexpr std::size_t kMostHeaderBytes = std::size_t{1} << 20;
constexpr std::string_view kMagic = "#INRIMAGE-4#{";
constexpr std::string_view kEnd = "\n##}\n";

struct InrHeader {
    std::uint64_t data_offset = 0;
    SampleFormat format;
    Lattice lattice;
};

class InrFields {
public:
    InrFields(const fs::path& path, std::string_view text) : path_(path) {
        while (!text.empty()) {
            const std::string_view line = take_line(text);
            const std::size_t equals = line.find('=');
            if (!line.starts_with('#') && equals != std::string_view::npos)
                fields_.emplace(trim(line.substr(0, equals)), trim(line.substr(equals + 1)));
        }
    }

    std::string_view text(std::string_view key, std::string_view otherwise = "") const {
        const auto found = fields_.find(key);
        return found == fields_.end() ? otherwise : found->second;
    }
    std::uint64_t size(std::string_view key, std::string_view otherwise = "") const {
        const auto number = parse_size(text(key, otherwise));
        if (!number) refuse(key, "a count is needed");
        return *number;
    }
    double real(std::string_view key, std::string_view otherwise) const {
        const auto number = parse_real(text(key, otherwise));
        if (!number || std::isnan(*number)) refuse(key, "a number is needed");
        return *number;
    }
    [[noreturn]] void refuse(std::string_view key, const std::string& wanted) const {
        fail(path_, fmt::format("{} is '{}': {}", key, shown(text(key)), wanted));
    }

private:
    const fs::path& path_;
    std::map<std::string_view, std::string_view> fields_;
};

SampleFormat sample_format(const InrFields& fields) {
    SampleFormat format;
    const std::string kind = lower(fields.text("TYPE"));
    if (kind != "unsigned fixed" && kind != "signed fixed")
        fields.refuse("TYPE", "labels must be integers ('unsigned fixed' or 'signed fixed'): convert them");
    const auto bits = split_words(fields.text("PIXSIZE"));
    const auto type = parse_sample_type((kind[0] == 'u' ? "uint" : "int") + std::string(bits.empty() ? "" : bits[0]));
    if (!type) fields.refuse("PIXSIZE", "8, 16, 32 or 64 bits are needed");
    format.type = *type;
    if (fields.text("SCALE", "2**0") != "2**0") fields.refuse("SCALE", "it rescales the samples; save labels unscaled");
    const std::string_view cpu = fields.text("CPU", "decm");
    format.is_big_endian = cpu == "sun" || cpu == "sgi";
    if (!format.is_big_endian && cpu != "decm" && cpu != "alpha" && cpu != "pc")
        fields.refuse("CPU", "sun, sgi, decm, alpha or pc is needed, which tells the order of bytes");
    return format;
}

/// `text` is the whole header, up to its end mark.
InrHeader parse_header(const fs::path& path, std::string_view text) {
    const InrFields fields(path, text);
    InrHeader header;
    header.data_offset = text.size();
    header.format = sample_format(fields);
    if (fields.size("VDIM", "1") != 1) fields.refuse("VDIM", "one value a sample is needed; save one alone");
    header.lattice.size = checked_size(path, {fields.size("XDIM"), fields.size("YDIM"), fields.size("ZDIM", "1")});
    for (int axis = 0; axis < 3; ++axis) {
        const char letter = "XYZ"[axis];
        const double spacing = fields.real(fmt::format("V{}", letter), "1");
        if (!(spacing > 0)) fields.refuse(fmt::format("V{}", letter), "a positive spacing is needed");
        header.lattice.spacing[axis] = spacing;
        header.lattice.origin[axis] = fields.real(fmt::format("T{}", letter), "0");
        if (fields.real(fmt::format("R{}", letter), "0") != 0)
            fields.refuse(fmt::format("R{}", letter), "turned volumes are not read; set it to 0 or resample");
    }
    return header;
}

/// Reads on until the line that ends a header.
InrHeader read_header(const fs::path& path, ByteStream& stream) {
    std::string text;
    std::size_t end = std::string::npos;
    while (end == std::string::npos) {
        const std::size_t held = text.size();
        text.resize(held + kBlockBytes);
        text.resize(held + stream.read(std::as_writable_bytes(std::span(text)).last(kBlockBytes)));
        if (!text.starts_with(kMagic)) fail(path, "not an INRIMAGE-4 file (it does not begin as one); check the file");
        if (text.size() == held || text.size() > kMostHeaderBytes)
            fail(path, "has a header without an end ('##}'); the file is truncated, fetch it again");
        end = text.find(kEnd, held - std::min(held, kEnd.size()));
    }
    return parse_header(path, std::string_view(text).substr(0, end + kEnd.size()));
}

}  // namespace

std::unique_ptr<SectionReader> open_inr(const fs::path& path, const ReadOptions& options) {
    InputFile file(path);
    const bool is_packed = is_gzipped(file);
    std::unique_ptr<ByteStream> stream;
    if (is_packed)
        stream = std::make_unique<DeflateStream>(InputFile(path));
    else
        stream = std::make_unique<PlainStream>(InputFile(path));
    const InrHeader header = read_header(path, *stream);
    VolumeInfo info = volume_info(path, "inr", header.format.type, header.lattice.size);
    info.lattice = header.lattice;
    info.names = names_beside(path);
    if (!is_packed) {
        info.can_sweep = {true, true, true};
        return open_flat(std::move(file), std::move(info), {.offset = header.data_offset, .format = header.format},
                         options);
    }
    check_inflated(path, file.size(), volume_bytes(path, header.lattice.size, sample_bytes(header.format.type)));
    stream->rewind();
    return open_stream(std::move(stream), std::move(info), {.offset = header.data_offset, .format = header.format},
                       options, "give --sweep z, or decompress the file first (gunzip)");
}

}  // namespace regionmesh::formats
