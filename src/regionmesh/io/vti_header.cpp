#include "regionmesh/io/vti_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <pugixml.hpp>
#include <string_view>
#include <utility>
#include <vector>

#include "regionmesh/io/affine.h"
#include "regionmesh/io/header_text.h"
#include "regionmesh/io/volume_size.h"

namespace regionmesh::io {
namespace {

constexpr std::size_t kMostTagBytes = std::size_t{4} << 20;  // of all tags together
constexpr std::size_t kChunkBytes = std::size_t{64} << 10;

constexpr std::array<std::pair<std::string_view, SampleType>, 8> kTypes{{{"Int8", SampleType::kI8},
                                                                         {"UInt8", SampleType::kU8},
                                                                         {"Int16", SampleType::kI16},
                                                                         {"UInt16", SampleType::kU16},
                                                                         {"Int32", SampleType::kI32},
                                                                         {"UInt32", SampleType::kU32},
                                                                         {"Int64", SampleType::kI64},
                                                                         {"UInt64", SampleType::kU64}}};

/// The tags of a file, where the text of each DataArray is replaced by its place: "begin end".
class TagScanner {
public:
    explicit TagScanner(const InputFile& file) : file_(file) {}

    /// Up to the appended data, or to the end of the root.
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

/// From '<' to '>', which may stand in quotes; comments whole.
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
        if (tags.size() > kMostTagBytes) fail(file_.path(), "has more than 4 MiB of tags; it is no image data");
        const bool is_empty = tag.ends_with("/>");
        if (tag.starts_with("<AppendedData") && !is_empty) {
            find_underscore();
            return tags + "</AppendedData></VTKFile>";
        }
        if (tag.starts_with("<DataArray") && !is_empty) {
            const std::uint64_t begin = place();
            skip_to('<');
            tags += fmt::format("{} {}", begin, place());
        }
        if (tag == "</VTKFile>") break;
    }
    return tags;
}

/// What one DataArray is, before one is chosen.
struct Candidate {
    pugi::xml_node node;
    bool is_cell = false;
    bool is_active = false;
    std::optional<SampleType> type;  // none for reals and the like

    std::string text() const {
        return fmt::format("{} ({} {}, {})", node.attribute("Name").value(), is_cell ? "cells" : "points",
                           node.attribute("type").value(), node.attribute("NumberOfComponents").as_int(1));
    }
};

std::vector<Candidate> find_candidates(pugi::xml_node piece) {
    std::vector<Candidate> found;
    for (const bool is_cell : {false, true}) {
        const pugi::xml_node data = piece.child(is_cell ? "CellData" : "PointData");
        const std::string_view active = data.attribute("Scalars").value();
        for (const pugi::xml_node node : data.children("DataArray")) {
            Candidate candidate{node, is_cell, !active.empty() && active == node.attribute("Name").value(), {}};
            const std::string_view type = node.attribute("type").value();
            for (const auto& [word, known] : kTypes)
                if (word == type && node.attribute("NumberOfComponents").as_int(1) == 1) candidate.type = known;
            found.push_back(candidate);
        }
    }
    return found;
}

Candidate choose_array(const InputFile& file, const std::vector<Candidate>& all) {
    const Candidate* chosen = nullptr;
    for (const bool is_active_only : {true, false}) {
        int count = 0;
        for (const Candidate& candidate : all) {
            if (!candidate.type || (is_active_only && !candidate.is_active)) continue;
            chosen = &candidate;
            ++count;
        }
        if (count == 1) return *chosen;
    }
    constexpr std::size_t kShown = 20;
    std::string names;
    for (std::size_t i = 0; i < std::min(all.size(), kShown); ++i) names += (i == 0 ? "" : "; ") + all[i].text();
    if (all.size() > kShown) names += fmt::format("; and {} more", all.size() - kShown);
    if (!chosen) {
        fail(file.path(), "has no array of integers with one component, as labels need; it has " +
                              (names.empty() ? "none at all" : names));
    }
    fail(file.path(), "has several arrays of integers; make the one with labels its active scalars: " + names);
}

/// Samples of cells lie at their centres, one fewer on each axis; an axis of one point has one cell, there.
void place_in_space(const InputFile& file, pugi::xml_node image, pugi::xml_node piece, bool is_cell, Lattice& lattice) {
    const auto numbers = [&](pugi::xml_node node, const char* name, std::size_t count, std::vector<double> otherwise) {
        const std::string_view text = node.attribute(name).value();
        if (text.empty() && !otherwise.empty()) return otherwise;
        auto found = parse_reals(text);
        if (!found || found->size() != count)
            fail(file.path(), fmt::format("{} is '{}': {} numbers are needed", name, shown(text), count));
        return *found;
    };
    const auto origin = numbers(image, "Origin", 3, {0, 0, 0}), spacing = numbers(image, "Spacing", 3, {1, 1, 1});
    const auto direction = numbers(image, "Direction", 9, {1, 0, 0, 0, 1, 0, 0, 0, 1});
    const std::string_view text = piece.attribute("Extent").value();
    std::vector<std::int64_t> extent;
    for (const std::string_view word : split_words(text))
        if (const auto number = parse_integer(word)) extent.push_back(*number);
    Columns columns;
    Vec3 first{origin[0], origin[1], origin[2]};
    std::array<std::uint64_t, 3> size{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        constexpr std::int64_t kMost = std::int64_t{1} << 40;
        if (extent.size() != 6 || extent[2 * axis] < -kMost || extent[2 * axis + 1] > kMost ||
            extent[2 * axis + 1] < extent[2 * axis])
            fail(file.path(), fmt::format("Extent is '{}': first and last index on each axis are needed", shown(text)));
        const std::int64_t low = extent[2 * axis], parts = extent[2 * axis + 1] - low;
        const bool is_between = is_cell && parts > 0;
        size[axis] = static_cast<std::uint64_t>(is_between ? parts : parts + 1);
        columns[axis] = spacing[axis] * Vec3{direction[axis], direction[3 + axis], direction[6 + axis]};
        first += (static_cast<double>(low) + (is_between ? 0.5 : 0)) * columns[axis];
    }
    lattice.size = checked_size(file.path(), size);
    set_affine(file.path(), "map to space", "mend Origin, Spacing or Direction", columns, first, lattice);
}

void place_in_file(const InputFile& file, pugi::xml_node root, std::uint64_t appended, pugi::xml_node node,
                   VtiArray& array) {
    const std::string_view format = node.attribute("format").value();
    if (format == "appended") {
        const std::string_view encoding = root.child("AppendedData").attribute("encoding").value();
        if (appended == 0 || (encoding != "raw" && encoding != "base64"))
            fail(file.path(), "has no appended data in raw or base64, which its array needs; write the file again");
        array.form = encoding == "raw" ? VtiArray::Form::kRaw : VtiArray::Form::kBase64;
        const auto offset = parse_size(node.attribute("offset").value());
        if (!offset || *offset > file.size() - std::min(appended, file.size()))
            fail(file.path(), fmt::format("array '{}' begins beyond the end of the file; the file is truncated",
                                          node.attribute("Name").value()));
        array.begin = appended + *offset;
        array.end = file.size();
        return;
    }
    if (format != "binary" && format != "ascii" && !format.empty())
        fail(file.path(), fmt::format("array format '{}': ascii, binary or appended is needed", shown(format)));
    array.form = format == "binary" ? VtiArray::Form::kBase64 : VtiArray::Form::kAscii;
    const auto places = parse_sizes(node.child_value());  // where the scanner found its text
    if (places && places->size() == 2) array.begin = (*places)[0], array.end = (*places)[1];
}

}  // namespace

VtiHeader read_vti_header(const InputFile& file) {
    TagScanner scanner(file);
    const std::string tags = scanner.scan();
    pugi::xml_document document;
    if (const auto result = document.load_buffer(tags.data(), tags.size()); !result)
        fail(file.path(), fmt::format("no XML: {}; check the file", result.description()));
    const pugi::xml_node root = document.child("VTKFile"), image = root.child("ImageData");
    const pugi::xml_node piece = image.child("Piece");
    if (!image) fail(file.path(), "is no VTK XML file with ImageData; other VTK data hold no sections");
    if (!piece || piece.next_sibling("Piece")) fail(file.path(), "has no Piece, or several; write it as one piece");
    const std::string_view compressor = root.attribute("compressor").value();
    if (!compressor.empty() && compressor != "vtkZLibDataCompressor")
        fail(file.path(), fmt::format("compressor '{}': write it with zlib or without", shown(compressor)));
    VtiHeader header;
    header.is_compressed = !compressor.empty();
    header.is_big_endian = std::string_view(root.attribute("byte_order").value()) == "BigEndian";
    header.word_bytes = std::string_view(root.attribute("header_type").value()) == "UInt64" ? 8 : 4;
    const Candidate chosen = choose_array(file, find_candidates(piece));
    header.array.type = *chosen.type;
    header.array.name = chosen.node.attribute("Name").value();
    place_in_space(file, image, piece, chosen.is_cell, header.lattice);
    place_in_file(file, root, scanner.appended(), chosen.node, header.array);
    return header;
}

}  // namespace regionmesh::io
