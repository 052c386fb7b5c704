#include "formats/surface/ply_header.h"

#include <algorithm>
#include <array>
#include <utility>

#include "formats/surface/file_surface.h"
#include "formats/text/header_text.h"

namespace regionmesh {
namespace {

constexpr std::uint64_t kLongestHeader = 1 << 24;  // names of regions stand in it
constexpr std::size_t kMostProperties = 1000;

constexpr std::array<std::pair<std::string_view, PlyType>, 16> kTypes{{{"char", PlyType::kInt8},
                                                                       {"int8", PlyType::kInt8},
                                                                       {"uchar", PlyType::kUint8},
                                                                       {"uint8", PlyType::kUint8},
                                                                       {"short", PlyType::kInt16},
                                                                       {"int16", PlyType::kInt16},
                                                                       {"ushort", PlyType::kUint16},
                                                                       {"uint16", PlyType::kUint16},
                                                                       {"int", PlyType::kInt32},
                                                                       {"int32", PlyType::kInt32},
                                                                       {"uint", PlyType::kUint32},
                                                                       {"uint32", PlyType::kUint32},
                                                                       {"float", PlyType::kFloat32},
                                                                       {"float32", PlyType::kFloat32},
                                                                       {"double", PlyType::kFloat64},
                                                                       {"float64", PlyType::kFloat64}}};

PlyType type_named(const formats::ByteReader& file, std::string_view word) {
    const auto at = std::find_if(kTypes.begin(), kTypes.end(), [&](const auto& type) { return type.first == word; });
    if (at == kTypes.end()) file.fail_line("'" + formats::one_line(word.substr(0, 40)) + "' is no type of a PLY file");
    return at->second;
}

PlyEncoding encoding_named(const formats::ByteReader& file, std::string_view word) {
    if (word == "ascii") return PlyEncoding::kText;
    if (word == "binary_little_endian") return PlyEncoding::kLittleEndian;
    if (word == "binary_big_endian") return PlyEncoding::kBigEndian;
    file.fail_line("'" + formats::one_line(word.substr(0, 40)) + "' is no format of a PLY file");
}

PlyElement read_element(const formats::ByteReader& file, std::string_view rest) {
    PlyElement element{.name = std::string(formats::take_word(rest))};
    const std::string_view count = formats::take_word(rest);
    const auto number = formats::to_integer(count);
    if (!number || count.starts_with('-'))
        file.fail_line("bad number of elements '" + formats::one_line(count.substr(0, 40)) + "'");
    element.count = static_cast<std::uint64_t>(*number);
    return element;
}

PlyProperty read_property(const formats::ByteReader& file, std::string_view rest) {
    PlyProperty property{.name = {}, .type = PlyType::kInt8, .count_type = {}};
    std::string_view type = formats::take_word(rest);
    if (type == "list") {
        property.count_type = type_named(file, formats::take_word(rest));
        if (*property.count_type >= PlyType::kFloat32) file.fail_line("the length of a list is no integer");
        type = formats::take_word(rest);
    }
    property.type = type_named(file, type);
    property.name = formats::take_word(rest);
    return property;
}

void read_comment(std::string_view rest, PlyHeader& header) {
    const std::string_view word = formats::take_word(rest), number = formats::take_word(rest);
    const auto label = formats::to_integer(number);
    if (!label) return;
    if (word == "exterior_label") header.exterior_label = *label;
    if (word == "region" && !formats::one_line(rest).empty()) header.names.try_emplace(*label, formats::one_line(rest));
}

void require_room(const formats::ByteReader& file, const PlyHeader& header) {
    std::uint64_t left = file.left();
    for (const PlyElement& element : header.elements) {
        const std::uint64_t least = element.least_bytes(header.encoding);
        const bool is_too_much = least > 0 ? element.count > left / least : element.count > file.size();
        if (is_too_much)
            file.fail("has " + std::to_string(file.left()) + " bytes after its header, which promises " +
                      std::to_string(element.count) + " elements '" + formats::one_line(element.name.substr(0, 40)) +
                      "': it was cut short");
        left -= element.count * least;
    }
}

}  // namespace

std::size_t bytes_of(PlyType type) {
    constexpr std::size_t kBytes[] = {1, 1, 2, 2, 4, 4, 4, 8};
    return kBytes[static_cast<int>(type)];
}

std::optional<std::size_t> PlyElement::find(std::string_view property) const {
    for (std::size_t n = 0; n < properties.size(); ++n)
        if (properties[n].name == property) return n;
    return std::nullopt;
}

/// In text each number takes a digit, and a space but for the last of the file.
std::uint64_t PlyElement::least_bytes(PlyEncoding encoding) const {
    std::uint64_t bytes = 0;
    for (const PlyProperty& property : properties)
        bytes += encoding == PlyEncoding::kText ? 1 : bytes_of(property.count_type.value_or(property.type));
    return bytes;
}

PlyHeader read_ply_header(formats::ByteReader& file) {
    PlyHeader header;
    // Looked at before a line is asked for: other files may have none.
    if (file.size() < 4 || !file.peek(4).starts_with("ply")) file.fail("is no PLY file");
    if (file.take_line() != "ply") file.fail("is no PLY file");
    bool has_format = false;
    while (file.size() - file.left() <= kLongestHeader) {
        const auto line = file.take_line();
        if (!line) break;
        std::string_view rest = *line;
        const std::string_view word = formats::take_word(rest);
        if (word == "end_header") {
            if (!has_format) break;
            require_room(file, header);
            return header;
        }
        if (word == "format") {
            header.encoding = encoding_named(file, formats::take_word(rest));
            has_format = true;
        } else if (word == "element") {
            header.elements.push_back(read_element(file, rest));
        } else if (word == "property") {
            if (header.elements.empty()) file.fail_line("a property comes before the first element");
            auto& properties = header.elements.back().properties;
            if (properties.size() == kMostProperties) file.fail_line("an element has too many properties");
            properties.push_back(read_property(file, rest));
        } else if (word == "comment") {
            read_comment(rest, header);
        }
    }
    file.fail("has no whole PLY header");
}

}  // namespace regionmesh
