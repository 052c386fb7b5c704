#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "formats/input_file.h"
#include "formats/text/header_text.h"
#include "regionmesh/label_names_file.h"

namespace regionmesh {
namespace {

using Fields = std::vector<std::string>;
using formats::trim;

constexpr std::uint64_t kMostBytes = std::uint64_t{4} << 20;  // as read_label_names()
constexpr std::size_t kMostFields = 1000;                     // of a row, likewise

/// The fields of a line, at most kMostFields + 1; quoted ones may hold the separator. Several blanks separate once.
Fields split(std::string_view line, char separator) {
    const bool is_blank = separator == ' ';
    Fields fields;
    std::string field;
    bool is_quoted = false, was_quoted = false;
    const auto end_field = [&] {
        if (!is_blank || !field.empty() || was_quoted) fields.emplace_back(was_quoted ? field : trim(field));
        field.clear();
        was_quoted = false;
    };
    for (const char letter : line) {
        if (fields.size() > kMostFields) return fields;
        const bool ends = letter == separator || (is_blank && letter == '\t');
        if (letter == '"')
            is_quoted = !is_quoted, was_quoted = true;
        else if (ends && !is_quoted)
            end_field();
        else
            field += letter;
    }
    end_field();
    return fields;
}

using Places = std::array<std::size_t, 3>;  // of red, green and blue

std::optional<std::uint32_t> colour_at(const Fields& fields, const Places& places) {
    std::uint32_t colour = 0;
    for (const std::size_t place : places) {
        const auto part = place < fields.size() ? formats::parse_byte(fields[place]) : std::nullopt;
        if (!part) return {};
        colour = colour << 8 | *part;
    }
    return colour;
}

bool is_label(const std::string& field) { return formats::parse_table_label(field).has_value(); }

/// The first column called one of `words`, capitals and signs aside, that `is_wanted`.
template <class IsWanted>
std::optional<std::size_t> column_of(const Fields& header, std::initializer_list<std::string_view> words,
                                     IsWanted&& is_wanted) {
    for (const std::string_view word : words)
        for (std::size_t column = 0; column < header.size(); ++column) {
            std::string name = formats::lower(header[column]);
            std::erase_if(name, [](unsigned char c) { return !std::isalnum(c); });
            if (name == word && is_wanted(column)) return column;
        }
    return {};
}
std::optional<std::size_t> column_of(const Fields& header, std::initializer_list<std::string_view> words) {
    return column_of(header, words, [](std::size_t) { return true; });
}

/// Where a table with a header has labels and colours.
struct Columns {
    std::size_t label = 0;
    std::optional<std::size_t> hex;
    std::optional<Places> parts;

    std::optional<std::uint32_t> colour(const Fields& fields) const {
        if (hex && *hex < fields.size()) return formats::parse_colour(fields[*hex]);
        return parts ? colour_at(fields, *parts) : std::nullopt;
    }
};

/// Labels are in the column with the first of these titles under which the first row has a label, since "label" may be
/// the title of names; or else in the first column with one.
Columns columns_of(const Fields& header, const Fields& first_row) {
    const auto has_label = [&](std::size_t column) { return column < first_row.size() && is_label(first_row[column]); };
    const std::size_t first = std::ranges::find_if(first_row, is_label) - first_row.begin();
    Columns columns{
        .label =
            column_of(header, {"label", "labelvalue", "labelid", "index", "value", "id", "key", "number", "roi", "no"},
                      has_label)
                .value_or(first),
        .hex = column_of(header, {"color", "colour", "hex", "rgb"}),
        .parts = {}};
    const auto red = column_of(header, {"r", "red", "colorr"}), green = column_of(header, {"g", "green", "colorg"}),
               blue = column_of(header, {"b", "blue", "colorb"});
    if (red && green && blue) columns.parts = Places{*red, *green, *blue};
    return columns;
}

/// Without a header: `label r g b a visible mesh "name"` (ITK-SNAP), or `label name r g b a` (FreeSurfer, 3D Slicer).
/// Nothing for a row of neither form.
std::optional<Places> places_in(const Fields& fields) {
    constexpr std::size_t kItkSnap = 8, kFreeSurfer = 6;
    const std::size_t count = fields.size();
    const auto are_numbers = [&](const Places& places) {
        return std::ranges::all_of(places,
                                   [&](std::size_t n) { return formats::parse_integer(fields[n]).has_value(); });
    };
    if (constexpr Places places{1, 2, 3};
        count >= kItkSnap && !formats::parse_byte(fields.back()) && are_numbers(places))
        return places;
    if (count < kFreeSurfer || !formats::parse_byte(fields.back()) || formats::parse_byte(fields[1])) return {};
    const Places places{count - 4, count - 3, count - 2};
    return are_numbers(places) ? std::optional(places) : std::nullopt;
}

char separator_of(std::string_view line) {
    for (const char separator : {'\t', ';', ','})
        if (line.find(separator) != std::string_view::npos) return separator;
    return ' ';
}

bool is_comment(std::string_view line) {
    return line.empty() || line.starts_with('#') || line.starts_with('%') || line.starts_with("//");
}

/// Takes the fields of the next line that is no comment off `text`; none at its end.
std::optional<Fields> take_row(std::string_view& text) {
    while (!text.empty())
        if (const std::string_view line = trim(formats::take_line(text)); !is_comment(line))
            return split(line, separator_of(line));
    return {};
}

}  // namespace

LabelColours read_label_colours(const std::filesystem::path& path) {
    const formats::InputFile file(path);
    if (file.size() > kMostBytes) return {};
    const std::string text = file.text();
    std::string_view rest = text;
    auto row = take_row(rest);
    if (!row) return {};
    Columns columns;
    if (std::ranges::none_of(*row, is_label)) {  // a header
        const Fields header = *std::exchange(row, take_row(rest));
        if (!row || header.size() > kMostFields) return {};
        columns = columns_of(header, *row);
        if (!columns.hex && !columns.parts) return {};
    }
    const bool is_by_place = !columns.hex && !columns.parts;
    LabelColours colours;
    std::size_t damaged = 0;
    for (; row; row = take_row(rest)) {
        if (row->size() > kMostFields) return {};
        const auto places = is_by_place ? places_in(*row) : std::nullopt;
        if (is_by_place && !places) return {};
        const auto colour = places ? colour_at(*row, *places) : columns.colour(*row);
        damaged += !colour;
        if (!colour || columns.label >= row->size()) continue;
        if (const auto label = formats::parse_table_label((*row)[columns.label])) colours.emplace(*label, *colour);
    }
    if (is_by_place && damaged >= colours.size()) return {};  // numbers of another kind
    return colours;
}

}  // namespace regionmesh
