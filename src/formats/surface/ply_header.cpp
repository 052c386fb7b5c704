#include "formats/surface/ply_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "formats/text/header_text.h"

namespace regionmesh {
namespace {

using formats::NumberType;
using formats::shown;
using formats::take_word;

constexpr std::uint64_t kLongestHeader = 1 << 24;  // it has the names of regions
constexpr std::size_t kMostProperties = 1000;

constexpr std::pair<std::string_view, NumberType> kTypes[] = {
    {"char", NumberType::kInt8},      {"int8", NumberType::kInt8},       {"uchar", NumberType::kUint8},
    {"uint8", NumberType::kUint8},    {"short", NumberType::kInt16},     {"int16", NumberType::kInt16},
    {"ushort", NumberType::kUint16},  {"uint16", NumberType::kUint16},   {"int", NumberType::kInt32},
    {"int32", NumberType::kInt32},    {"uint", NumberType::kUint32},     {"uint32", NumberType::kUint32},
    {"float", NumberType::kFloat32},  {"float32", NumberType::kFloat32}, {"double", NumberType::kFloat64},
    {"float64", NumberType::kFloat64}};
constexpr std::pair<std::string_view, PlyEncoding> kEncodings[] = {{"ascii", PlyEncoding::kText},
                                                                   {"binary_little_endian", PlyEncoding::kLittleEndian},
                                                                   {"binary_big_endian", PlyEncoding::kBigEndian}};

/// The value that a word has in a table.
template <class Value, std::size_t N>
Value value_of(const std::pair<std::string_view, Value> (&table)[N], std::string_view word, const char* kind,
               const formats::ByteReader& file) {
    for (const auto& [name, value] : table)
        if (name == word) return value;
    file.fail_line(fmt::format("'{}' is no {} of a PLY file", shown(word), kind));
}

PlyElement read_element(const formats::ByteReader& file, std::string_view rest) {
    PlyElement element{.name = std::string(take_word(rest))};
    const std::string_view count = take_word(rest);
    const auto number = formats::parse_size(count);
    if (!number) file.fail_line(fmt::format("bad number of elements '{}'", shown(count)));
    element.count = *number;
    return element;
}

PlyProperty read_property(const formats::ByteReader& file, std::string_view rest) {
    const auto take_type = [&] { return value_of(kTypes, take_word(rest), "type", file); };
    PlyProperty property{.name = {}, .type = NumberType::kInt8, .count_type = {}};
    if (std::string_view ahead = rest; take_word(ahead) == "list") {
        rest = ahead;
        property.count_type = take_type();
        if (is_real(*property.count_type)) file.fail_line("the length of a list is no integer");
    }
    property.type = take_type();
    property.name = take_word(rest);
    return property;
}

/// Bytes that an element takes at least; in text each number takes a digit, and a space but for the last of the file.
std::uint64_t least_bytes(const PlyElement& element, PlyEncoding encoding) {
    std::uint64_t bytes = 0;
    for (const PlyProperty& property : element.properties)
        bytes += encoding == PlyEncoding::kText ? 1 : bytes_of(property.count_type.value_or(property.type));
    return bytes;
}

void require_room(const formats::ByteReader& file, const PlyHeader& header) {
    std::uint64_t left = file.left();
    for (const PlyElement& element : header.elements) {
        const std::uint64_t least = least_bytes(element, header.encoding);
        const bool is_too_much = least > 0 ? element.count > left / least : element.count > file.size();
        if (is_too_much)
            file.fail(fmt::format("has {} bytes after its header, which promises {} elements '{}': it was cut short",
                                  file.left(), element.count, shown(element.name)));
        left -= element.count * least;
    }
}

}  // namespace

std::optional<std::size_t> PlyElement::find(std::string_view property) const {
    const auto found = std::ranges::find(properties, property, &PlyProperty::name);
    return found == properties.end() ? std::nullopt : std::optional<std::size_t>(found - properties.begin());
}

PlyHeader read_ply_header(formats::ByteReader& file, FileSurface& surface) {
    PlyHeader header;
    // Checked before taking a line: other files may not have lines.
    if (file.size() < 4 || !file.peek(4).starts_with("ply")) file.fail("is no PLY file");
    const std::string_view first = *file.take_line();
    file.require_line_ends(first);
    if (formats::trim(first) != "ply") file.fail("is no PLY file");
    bool has_format = false;
    while (file.size() - file.left() <= kLongestHeader) {
        const auto line = file.take_line();
        if (!line) break;
        std::string_view rest = *line;
        const std::string_view word = take_word(rest);
        if (word == "end_header") {
            if (!has_format) break;
            require_room(file, header);
            return header;
        }
        if (word == "format") {
            header.encoding = value_of(kEncodings, take_word(rest), "format", file);
            has_format = true;
        } else if (word == "element") {
            header.elements.push_back(read_element(file, rest));
        } else if (word == "property") {
            if (header.elements.empty()) file.fail_line("a property comes before the first element");
            auto& properties = header.elements.back().properties;
            if (properties.size() == kMostProperties) file.fail_line("an element has too many properties");
            properties.push_back(read_property(file, rest));
        } else if (word == "comment") {
            read_comment(surface, rest);
        }
    }
    file.fail("has no whole PLY header");
}

}  // namespace regionmesh
