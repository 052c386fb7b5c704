// The INRIMAGE-4 format of INRIA, which CGAL reads: a text header, most often of 256 bytes, then bare samples.
#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "formats/array/array_file.h"
#include "formats/array/header_fields.h"
#include "formats/array/volume_formats.h"
#include "formats/array/volume_size.h"
#include "formats/text/header_text.h"
#include "regionmesh/label_names_file.h"

namespace regionmesh::formats {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kBlockBytes = 256;
constexpr std::size_t kMostHeaderBytes = std::size_t{1} << 20;
constexpr std::string_view kMagic = "#INRIMAGE-4#{";
constexpr std::string_view kEnd = "\n##}\n";

/// The header up to and including the line that ends it.
std::string header_text(const fs::path& path, ByteStream& stream) {
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
    return text.substr(0, end + kEnd.size());
}

HeaderFields parse_fields(const fs::path& path, std::string_view text) {
    HeaderFields fields(path);
    while (!text.empty()) {
        const std::string_view line = take_line(text);
        const std::size_t equals = line.find('=');
        if (!line.starts_with('#') && equals != std::string_view::npos)
            fields.add(trim(line.substr(0, equals)), line.substr(equals + 1));
    }
    return fields;
}

SampleFormat sample_format(const HeaderFields& fields) {
    SampleFormat format;
    const std::string kind = lower(fields.text({"TYPE"}));
    const bool is_real = kind == "float";
    if (!is_real && kind != "unsigned fixed" && kind != "signed fixed")
        fields.refuse("TYPE", "labels must be integers ('unsigned fixed' or 'signed fixed'): convert them");
    const auto bits = split_words(fields.text({"PIXSIZE"}));
    const std::string_view size = bits.empty() ? "" : bits[0];
    if (is_real && size != "32" && size != "64") fields.refuse("PIXSIZE", "32 or 64 bits are needed");
    if (is_real) format = real_format(size == "32" ? NumberType::kFloat32 : NumberType::kFloat64, false);
    const auto type =
        is_real ? SampleType::kI64 : parse_sample_type((kind[0] == 'u' ? "uint" : "int") + std::string(size));
    if (!type) fields.refuse("PIXSIZE", "8, 16, 32 or 64 bits are needed");
    format.type = *type;
    if (fields.text({"SCALE"}, "2**0") != "2**0")
        fields.refuse("SCALE", "it rescales the samples; save labels unscaled");
    const std::string_view cpu = fields.text({"CPU"}, "decm");
    format.is_big_endian = cpu == "sun" || cpu == "sgi";
    if (!format.is_big_endian && cpu != "decm" && cpu != "alpha" && cpu != "pc")
        fields.refuse("CPU", "sun, sgi, decm, alpha or pc is needed, which tells the order of bytes");
    return format;
}

Lattice parse_lattice(const HeaderFields& fields) {
    Lattice lattice;
    if (fields.size("VDIM", "1") != 1) fields.refuse("VDIM", "one value a sample is needed; save one alone");
    lattice.size = checked_size(fields.path(), {fields.size("XDIM"), fields.size("YDIM"), fields.size("ZDIM", "1")});
    for (int axis = 0; axis < 3; ++axis) {
        const auto key = [&](char kind) { return std::string{kind, "XYZ"[axis]}; };
        lattice.spacing[axis] = fields.real(key('V'), "1");
        if (!(lattice.spacing[axis] > 0)) fields.refuse(key('V'), "a positive spacing is needed");
        lattice.origin[axis] = fields.real(key('T'), "0");
        if (fields.real(key('R'), "0") != 0)
            fields.refuse(key('R'), "turned volumes are not read; set it to 0 or resample");
    }
    return lattice;
}

}  // namespace

std::unique_ptr<SectionReader> open_inr(const fs::path& path, const ReadOptions& options) {
    ArrayFile array{.format = "inr", .source = path, .remedy = "decompress the file first (gunzip)"};
    const std::string text = header_text(path, *open_inflated(path, array.encoding));
    const HeaderFields fields = parse_fields(path, text);
    array.skipped_bytes = static_cast<std::int64_t>(text.size());
    array.sample = sample_format(fields);
    array.lattice = parse_lattice(fields);
    take_table_beside(array);
    return open_array(array, options);
}

}  // namespace regionmesh::formats
