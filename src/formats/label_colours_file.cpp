#include <algorithm>
#include <array>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "formats/input_file.h"
#include "formats/text/header_text.h"
#include "formats/text/label_rows.h"
#include "regionmesh/label_names_file.h"

namespace regionmesh {
namespace {

using Fields = std::vector<std::string>;
using formats::column_titled, formats::is_label, formats::kMostTableColumns, formats::trim;

/// The fields of a line, at most kMostTableColumns + 1; quoted ones may hold the separator. Several blanks separate
/// once.
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
        if (fields.size() > kMostTableColumns) return fields;
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

std::optional<std::size_t> column_titled(const Fields& header, std::initializer_list<std::string_view> titles) {
    return column_titled(header, std::span(titles.begin(), titles.size()), [](std::size_t) { return true; });
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
    Columns columns{.label = column_titled(header, formats::kLabelTitles, has_label).value_or(first),
                    .hex = column_titled(header, {"color", "colour", "hex", "rgb"}),
                    .parts = {}};
    const auto red = column_titled(header, {"r", "red", "colorr"}),
               green = column_titled(header, {"g", "green", "colorg"}),
               blue = column_titled(header, {"b", "blue", "colorb"});
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

/// Takes the fields of the next line that is no comment off `text`; none at its end.
std::optional<Fields> take_row(std::string_view& text) {
    while (!text.empty())
        if (const std::string_view line = trim(formats::take_line(text)); !line.empty() && !formats::is_comment(line))
            return split(line, separator_of(line));
    return {};
}

}  // namespace

LabelColours read_label_colours(const std::filesystem::path& path) {
    const formats::InputFile file(path);
    if (file.size() > formats::kMostTableBytes) return {};
    const std::string text = file.text();
    std::string_view rest = text;
    auto row = take_row(rest);
    if (!row) return {};
    Columns columns;
    if (std::ranges::none_of(*row, is_label)) {  // a header
        const Fields header = *std::exchange(row, take_row(rest));
        if (!row || header.size() > kMostTableColumns) return {};
        columns = columns_of(header, *row);
        if (!columns.hex && !columns.parts) return {};
    }
    const bool is_by_place = !columns.hex && !columns.parts;
    LabelColours colours;
    std::size_t damaged = 0;
    for (; row; row = take_row(rest)) {
        if (row->size() > kMostTableColumns) return {};
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
