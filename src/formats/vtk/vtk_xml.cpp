#include "formats/vtk/vtk_xml.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <utility>

#include "formats/codec/base64.h"
#include "formats/text/header_text.h"
#include "formats/vtk/vtk_blocks.h"

namespace regionmesh::formats {
namespace {

constexpr std::size_t kMostTagBytes = std::size_t{4} << 20;  // of all tags together
constexpr std::size_t kChunkBytes = std::size_t{64} << 10;

/// Collects the tags of a file; replaces the text of each DataArray by its place in the file, "begin end".
class TagScanner {
public:
    explicit TagScanner(const InputFile& file) : file_(file) {}

    /// The tags up to the appended data, or to the end of the root.
    std::string scan();
    std::uint64_t appended() const { return appended_; }  // the byte behind the underscore; 0 if there is none

private:
    bool at_end() { return here_ == held_ && !refill(); }
    char peek() const { return chunk_[here_]; }
    std::uint64_t place() const { return chunk_place_ + here_; }
    bool refill();
    void skip_to(char wanted);
    std::string take_tag();
    void find_underscore();

    const InputFile& file_;
    std::string chunk_ = std::string(kChunkBytes, '\0');
    std::uint64_t chunk_place_ = 0;
    std::size_t here_ = 0, held_ = 0;
    std::uint64_t appended_ = 0;
};

bool TagScanner::refill() {
    chunk_place_ += held_;
    here_ = 0;
    held_ = file_.read(chunk_place_, std::as_writable_bytes(std::span(chunk_)));
    return held_ > 0;
}

void TagScanner::skip_to(char wanted) {
    while (!at_end()) {
        here_ = std::min(std::string_view(chunk_).substr(0, held_).find(wanted, here_), held_);
        if (here_ < held_) return;
    }
}

/// The text from '<' to the closing '>', one that is not in quotes; comments to their end.
std::string TagScanner::take_tag() {
    std::string tag;
    char quote = '\0';
    while (!at_end()) {
        if (tag.size() > kMostTagBytes) fail(file_.path(), "has a tag of more than 4 MiB; it is no VTK XML file");
        const char c = tag.empty() ? '<' : peek();
        tag += c;
        ++here_;
        const bool is_comment = tag.starts_with("<!--");
        if (is_comment ? tag.ends_with("-->") && tag.size() >= 7 : c == '>' && quote == '\0') return tag;
        if (quote == c)
            quote = '\0';
        else if (quote == '\0' && (c == '"' || c == '\''))
            quote = c;
    }
    fail(file_.path(), "ends in the middle of its XML; the file is truncated, fetch it again");
}

void TagScanner::find_underscore() {
    while (!at_end() && (peek() == ' ' || (peek() >= '\t' && peek() <= '\r'))) ++here_;
    if (at_end() || peek() != '_') fail(file_.path(), "its AppendedData does not begin with an underscore");
    appended_ = place() + 1;
}

std::string TagScanner::scan() {
    std::string tags;
    for (skip_to('<'); !at_end(); skip_to('<')) {
        const std::string tag = take_tag();
        if (tag.starts_with("<!--")) continue;
        tags += tag;
        if (tags.size() > kMostTagBytes) fail(file_.path(), "has more than 4 MiB of tags; write it as fewer pieces");
        const bool is_empty = tag.ends_with("/>");
        if (tag.starts_with("<AppendedData") && !is_empty) {
            find_underscore();
            return tags + "</AppendedData></VTKFile>";
        }
        if ((tag.starts_with("<DataArray") || tag.starts_with("<Array")) && !is_empty) {
            const std::uint64_t begin = place();
            skip_to('<');
            tags += fmt::format("{} {}", begin, place());
        }
        if (tag == "</VTKFile>") break;
    }
    return tags;
}

}  // namespace

VtkXml::VtkXml(const std::filesystem::path& path, const char* type) : path_(path) {
    const InputFile file(path);
    file_bytes_ = file.size();
    TagScanner scanner(file);
    const std::string tags = scanner.scan();
    appended_ = scanner.appended();
    if (const auto result = document_.load_buffer(tags.data(), tags.size()); !result)
        fail(fmt::format("no XML: {}; check the file", result.description()));
    const pugi::xml_node root = document_.child("VTKFile");
    dataset_ = root.child(type);
    if (!dataset_) fail(fmt::format("is no VTK XML file with {}; check the file", type));
    const std::string_view compressor = root.attribute("compressor").value();
    if (!compressor.empty() && compressor != "vtkZLibDataCompressor")
        fail(fmt::format("compressor '{}': write it with zlib or without", shown(compressor)));
    encoding_.is_compressed = !compressor.empty();
    encoding_.is_big_endian = std::string_view(root.attribute("byte_order").value()) == "BigEndian";
    encoding_.word_bytes = std::string_view(root.attribute("header_type").value()) == "UInt64" ? 8 : 4;
}

void VtkXml::fail(const std::string& text) const { formats::fail(path_, text); }

void VtkXml::fail(pugi::xml_node array, const std::string& text) const {
    fail(fmt::format("array '{}': {}", shown(array.attribute("Name").value()), text));
}

VtkArrayPlace VtkXml::place_of(pugi::xml_node array) const {
    using Form = VtkArrayPlace::Form;
    const std::string_view format = array.attribute("format").value();
    if (format == "appended") {
        const std::string_view encoding =
            document_.child("VTKFile").child("AppendedData").attribute("encoding").value();
        if (appended_ == 0 || (encoding != "raw" && encoding != "base64"))
            fail("has no appended data in raw or base64, which its array needs; write the file again");
        const auto offset = parse_size(array.attribute("offset").value());
        if (!offset || *offset > file_bytes_ - std::min(appended_, file_bytes_))
            fail(array, "begins beyond the end of the file; it is truncated, fetch it again");
        return {encoding == "raw" ? Form::kRaw : Form::kBase64, appended_ + *offset, file_bytes_};
    }
    if (format != "binary" && format != "ascii" && !format.empty())
        fail(fmt::format("array format '{}': ascii, binary or appended is needed", shown(format)));
    VtkArrayPlace place{.form = format == "binary" ? Form::kBase64 : Form::kAscii};
    const auto places = parse_sizes(array.child_value());  // where the scanner found its text
    if (places && places->size() == 2) place.begin = (*places)[0], place.end = (*places)[1];
    return place;
}

std::unique_ptr<ByteStream> VtkXml::open_stored(const VtkArrayPlace& place) const {
    if (place.form == VtkArrayPlace::Form::kRaw) return std::make_unique<PlainStream>(InputFile(path_), place.begin);
    return std::make_unique<Base64Stream>(InputFile(path_), place.begin, place.end);
}

VtkBytes VtkXml::open(pugi::xml_node array) const {
    const VtkArrayPlace place = place_of(array);
    if (encoding_.is_compressed) {
        auto blocks = std::make_unique<VtkBlocks>(open_stored(place), open_stored(place), encoding_);
        const auto bytes = blocks->inflated_bytes();
        if (!bytes) fail(array, blocks->problem());
        return {std::move(blocks), 0, *bytes};
    }
    VtkBytes found{open_stored(place), encoding_.word_bytes, 0};
    std::array<std::byte, 8> bytes{};
    const auto word = std::span(bytes).first(encoding_.word_bytes);
    if (found.stream->read(word) < word.size()) fail(array, found.stream->problem());
    found.count = decode_word(word, encoding_.is_big_endian);
    found.stream->rewind();
    return found;
}

pugi::xml_node VtkXml::required_array(pugi::xml_node cells, const char* name) const {
    const pugi::xml_node array = array_named(cells, name);
    if (!array) fail(fmt::format("needs the array '{}' in {}", name, cells.empty() ? "Cells" : cells.name()));
    return array;
}

std::uint64_t VtkXml::count(pugi::xml_node node, const char* attribute, std::uint64_t most) const {
    const std::string_view text = node.attribute(attribute).value();
    const auto number = text.empty() ? 0 : parse_size(text);
    if (!number || *number > most)
        fail(fmt::format("{} is '{}': a count of at most {} is needed", attribute, shown(text), most));
    return *number;
}

std::optional<NumberType> vtk_type_named(std::string_view name) {
    constexpr std::array<std::string_view, 10> kNames{"Int8",   "UInt8", "Int16",  "UInt16",  "Int32",
                                                      "UInt32", "Int64", "UInt64", "Float32", "Float64"};
    const auto found = std::find(kNames.begin(), kNames.end(), name);
    if (found == kNames.end()) return std::nullopt;
    return static_cast<NumberType>(found - kNames.begin());
}

std::optional<NumberType> vtk_type(pugi::xml_node array) { return vtk_type_named(array.attribute("type").value()); }

std::uint64_t components(pugi::xml_node array) {
    const std::string_view text = array.attribute("NumberOfComponents").value();
    return text.empty() ? 1 : parse_size(text).value_or(0);
}

std::vector<pugi::xml_node> arrays_of(pugi::xml_node piece, bool cells_first) {
    std::vector<pugi::xml_node> arrays;
    for (const bool is_cell : {cells_first, !cells_first})
        for (const pugi::xml_node node : piece.child(is_cell ? "CellData" : "PointData").children("DataArray"))
            if (vtk_type(node)) arrays.push_back(node);
    return arrays;
}

MeshArray describe(pugi::xml_node array) {
    const auto type = vtk_type(array);
    return {.name = array.attribute("Name").value(),
            .is_cell = std::string_view(array.parent().name()) == "CellData",
            .is_integer = type && !is_real(*type),
            .type = array.attribute("type").value(),
            .components = components(array)};
}

std::uint64_t decode_word(std::span<const std::byte> bytes, bool is_big_endian) {
    return bytes.size() == 8 ? load<std::uint64_t>(bytes.data(), is_big_endian)
                             : load<std::uint32_t>(bytes.data(), is_big_endian);
}

}  // namespace regionmesh::formats
