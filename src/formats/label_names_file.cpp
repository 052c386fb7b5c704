#include "regionmesh/label_names_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "formats/input_file.h"
#include "formats/text/csv_rows.h"
#include "formats/text/header_text.h"
#include "formats/text/label_rows.h"
#include "regionmesh/error.h"

namespace regionmesh {
namespace {

namespace fs = std::filesystem;
using formats::is_label, formats::trim;

constexpr std::size_t kMostFields = std::size_t{1} << 20;  // of a table
constexpr char kBlank = ' ';                               // the separator of tables that have no other

struct Row {
    std::uint64_t number;
    std::vector<std::string> fields;
};

bool is_number(std::string_view text) {
    return text.find_first_not_of("0123456789+-.eE") == std::string_view::npos && formats::parse_real(text).has_value();
}

/// The same lines, with comment lines made empty.
std::string without_comments(std::string_view text) {
    std::string kept;
    while (!text.empty()) {
        const std::string_view line = text.substr(0, text.find('\n')), words = trim(line);
        if (!formats::is_comment(words)) kept += line;
        kept += '\n';
        text.remove_prefix(std::min(line.size() + 1, text.size()));
    }
    return kept;
}

/// Turns the text of a table into names.
class TableReader {
public:
    TableReader(const fs::path& path, std::string_view text) : path_(path), text_(without_comments(text)) {}

    LabelNames read();

private:
    std::vector<Row> split(char separator) const;
    bool find_rows(char separator);
    void join_words();
    std::optional<std::size_t> first_column(bool has_labels) const;
    bool column_has(std::size_t column, bool (*is_wanted)(std::string_view)) const;
    [[noreturn]] void refuse(std::uint64_t row, const std::string& text) const {
        formats::fail(path_, fmt::format("row {}: {}", row, text));
    }

    const fs::path& path_;
    std::string text_;
    std::vector<Row> rows_;
};

std::vector<Row> TableReader::split(char separator) const {
    std::string text = text_;
    if (separator == kBlank)
        std::replace_if(
            text.begin(), text.end(), [](char c) { return c == '\t' || c == '\v' || c == '\f'; }, kBlank);
    std::vector<Row> rows;
    std::size_t fields = 0;
    for (formats::CsvRows found(formats::InputFile(path_), std::move(text), separator); found.next();) {
        if (found.field_count() > formats::kMostTableColumns)
            refuse(found.number(), "has more than 1000 columns: no table of names");
        if ((fields += found.field_count()) > kMostFields)
            refuse(found.number(), "is behind more than a million fields: no table of names");
        Row row{found.number(), {}};
        for (std::size_t i = 0; i < found.field_count(); ++i)
            if (separator != kBlank || !found.field(i).empty()) row.fields.emplace_back(found.field(i));
        rows.push_back(std::move(row));
    }
    return rows;
}

/// Whether a line ends inside quotes, which a field begins with; `is_quoted`: whether the line before did.
bool ends_in_quotes(std::string_view line, char separator, bool is_quoted) {
    bool is_begin = true;  // of a field
    for (std::size_t at = 0; at < line.size(); ++at) {
        if (is_quoted && line[at] == '"' && line.substr(at + 1).starts_with('"'))
            ++at;  // a quote within the field
        else if (line[at] == '"' && (is_quoted || is_begin))
            is_quoted = !is_quoted;
        is_begin = line[at] == separator || (is_begin && line[at] == ' ');
    }
    return is_quoted;
}

/// Accepts a separator that occurs in every row, unless in the last row (never a header) only blanks separate a label.
bool TableReader::find_rows(char separator) {
    bool is_quoted = false;  // a name may contain a line end
    for (std::string_view rest = text_; !rest.empty();) {
        const std::string_view line = formats::take_line(rest);
        if (!is_quoted && !trim(line).empty() && line.find(separator) == std::string_view::npos) return false;
        is_quoted = ends_in_quotes(line, separator, is_quoted);
    }
    rows_ = split(separator);
    if (rows_.empty() || std::any_of(rows_.begin(), rows_.end(), [](const Row& row) { return row.fields.size() < 2; }))
        return false;
    const std::vector<std::string>& last = rows_.back().fields;
    const auto words = formats::split_words(last[0]);
    return std::any_of(last.begin(), last.end(), is_label) || words.empty() || !is_label(words[0]);
}

/// In a table without separators each row becomes its label and its name: all words from the first that is no number.
/// Trailing numbers that every row has are dropped from the names where they are colours (three or more; of more than
/// four, the last four where these may be red, green, blue and alpha), or where the names differ without them
/// ("1 Precentral_L 2001", but not "1 Brodmann area 4"). Rows of numbers alone have no name, and are left out.
void TableReader::join_words() {
    if (!rows_.empty() && !is_label(rows_[0].fields[0])) rows_.erase(rows_.begin());  // a header
    std::size_t dropped = SIZE_MAX;
    for (const Row& row : rows_) {
        std::size_t numbers = 0;
        while (numbers + 2 < row.fields.size() && is_number(row.fields[row.fields.size() - 1 - numbers])) ++numbers;
        dropped = std::min(dropped, numbers);
    }
    constexpr std::size_t kColours = 4;
    const auto has_colours = [](const Row& row) {
        return std::all_of(row.fields.end() - kColours, row.fields.end(),
                           [](const std::string& field) { return formats::parse_byte(field).has_value(); });
    };
    if (dropped > kColours && std::all_of(rows_.begin(), rows_.end(), has_colours)) dropped = kColours;
    const auto name_of = [](const Row& row, std::size_t without) {
        std::string name;
        for (std::size_t i = 1; i < row.fields.size() - without; ++i) {
            if (name.empty() && is_number(row.fields[i])) continue;
            name += (name.empty() ? "" : " ") + row.fields[i];
        }
        return name;
    };
    if (dropped < 3) {
        std::vector<std::string> names;
        for (const Row& row : rows_) names.push_back(name_of(row, dropped));
        std::sort(names.begin(), names.end());
        if (std::adjacent_find(names.begin(), names.end()) != names.end()) dropped = 0;
    }
    constexpr const char* kNoName = "has no name behind the label; write 'label,name'";
    // Among rows such as "3,c" the row "4" lacks a name.
    for (const bool is_label_alone : {true, false})
        for (const Row& row : rows_)
            if (row.fields.size() < 2 && is_label(row.fields[0]) == is_label_alone) refuse(row.number, kNoName);
    std::vector<Row> named;
    for (const Row& row : rows_) {
        const std::string name = name_of(row, dropped);
        if (!name.empty()) named.push_back({row.number, {row.fields[0], name}});
    }
    if (named.empty() && !rows_.empty()) refuse(rows_[0].number, kNoName);
    rows_ = std::move(named);
}

/// Whether the fields of a column satisfy `is_wanted`; rows with too few columns are reported later.
bool TableReader::column_has(std::size_t column, bool (*is_wanted)(std::string_view)) const {
    return std::all_of(rows_.begin(), rows_.end(),
                       [&](const Row& row) { return column >= row.fields.size() || is_wanted(row.fields[column]); });
}

std::optional<std::size_t> TableReader::first_column(bool has_labels) const {
    for (std::size_t column = 0; column < rows_[0].fields.size(); ++column)
        if (has_labels ? column_has(column, is_label) : !column_has(column, is_number)) return column;
    return std::nullopt;
}

LabelNames TableReader::read() {
    static constexpr std::string_view kNameTitles[]{"name",      "labelname", "regionname",  "structurename", "region",
                                                    "structure", "label",     "description", "text"};
    if (!find_rows('\t') && !find_rows(';') && !find_rows(',')) {
        rows_ = split(kBlank);
        join_words();
    }
    std::optional<Row> header;
    if (!rows_.empty() && std::none_of(rows_[0].fields.begin(), rows_[0].fields.end(), is_label)) {
        header = rows_[0];
        rows_.erase(rows_.begin());
    }
    if (rows_.empty()) formats::fail(path_, "holds no labels and names; write lines 'label,name'");
    std::optional<std::size_t> labels, names;
    if (header)
        labels = formats::column_titled(header->fields, formats::kLabelTitles,
                                        [&](std::size_t column) { return column_has(column, is_label); });
    if (!labels) labels = first_column(true);
    if (header)
        names =
            formats::column_titled(header->fields, kNameTitles, [&](std::size_t column) { return column != labels; });
    if (!names) names = first_column(false);
    if (!labels) labels = 0;  // some row has no label; the error below names it
    if (!names) formats::fail(path_, "has no column of names, only numbers; write lines 'label,name'");
    LabelNames result;
    for (const Row& row : rows_) {
        if (row.fields.size() <= std::max(*labels, *names))
            refuse(row.number,
                   fmt::format("has {} columns where others have more; write 'label,name'", row.fields.size()));
        const auto label = formats::parse_table_label(row.fields[*labels]);
        if (!label)
            refuse(row.number,
                   fmt::format("'{}' is no label; a whole number is needed", row.fields[*labels].substr(0, 40)));
        const std::string name = formats::one_line(row.fields[*names]);
        if (name.empty()) continue;
        const auto [known, is_new] = result.emplace(*label, name);
        if (!is_new && known->second != name)
            refuse(row.number, fmt::format("label {} is called '{}' and '{}'; keep one", *label, known->second, name));
    }
    return result;
}

/// FSL counts the structures of probabilistic atlases from 0, where their label volumes count from 1.
LabelNames read_xml(const fs::path& path, const std::string& text) {
    pugi::xml_document document;
    if (!document.load_buffer(text.data(), text.size())) formats::fail(path, "is no whole XML; fetch the file again");
    const pugi::xml_node atlas = document.child("atlas");
    const bool counts_from_0 = formats::one_line(atlas.child("header").child_value("type")).starts_with("Prob");
    LabelNames result;
    for (const pugi::xml_node node : atlas.child("data").children("label")) {
        const pugi::xml_attribute index = node.attribute("index");
        const auto label = formats::parse_table_label(trim(index ? index.value() : node.child_value("index")));
        const std::string name = formats::one_line(index ? node.child_value() : node.child_value("name"));
        if (!label) formats::fail(path, fmt::format("the label of '{}' is no whole number; mend it", name));
        if (!name.empty())
            result.emplace(static_cast<InputLabel>(static_cast<std::uint64_t>(*label) + counts_from_0), name);
    }
    return result;
}

/// Whether at least half of the lines below a header do, so that the file is meant as a table.
bool begins_with_labels(const fs::path& path) {
    const formats::InputFile file(path);
    if (file.size() > formats::kMostTableBytes) return false;
    const std::string text = without_comments(file.text());
    std::size_t lines = 0, labelled = 0;
    for (std::string_view rest = text; !rest.empty();) {
        const auto words = formats::split_words(formats::take_line(rest), " \t\r,;\"");
        lines += !words.empty();
        labelled += words.size() > 1 && is_label(words[0]);
    }
    return labelled > 0 && 2 * labelled + 1 >= lines;  // one may be a header
}

}  // namespace

LabelNames read_label_names(const fs::path& path) {
    const formats::InputFile file(path);
    if (file.size() > formats::kMostTableBytes)
        formats::fail(path, "is larger than 4 MiB: no table of names; name another file");
    const std::string text = file.text();
    if (text.find('\0') != std::string::npos)
        formats::fail(path, "is no text (in UTF-8); name a table of labels and names");
    const std::size_t begin = text.find_first_not_of(" \t\r\n");
    const bool is_xml = begin != std::string::npos && text[begin] == '<';
    const LabelNames names = is_xml ? read_xml(path, text) : TableReader(path, text).read();
    if (names.empty()) formats::fail(path, "holds no names; write lines 'label,name'");
    return names;
}

formats::NamesAndColours formats::table_beside(const fs::path& volume) {
    fs::path stem = volume;
    if (stem.extension() == ".gz" || stem.extension() == ".GZ") stem.replace_extension();
    const fs::path short_stem = fs::path(stem).replace_extension();
    for (const char* extension : {".txt", ".xml", ".tsv", ".csv", ".label", ".ctbl"}) {
        for (const fs::path& base : {stem, short_stem}) {
            const fs::path beside = base.string() + extension;
            std::error_code ignored;
            if (beside == volume || !fs::is_regular_file(beside, ignored)) continue;
            try {
                return {.names = read_label_names(beside), .colours = read_label_colours(beside)};
            } catch (const Error& error) {
                if (begins_with_labels(beside)) return {.warning = fmt::format("has no names: {}", error.what())};
                // Else a file of that name for another purpose: the volume is read without names.
            }
        }
    }
    return {};
}

}  // namespace regionmesh
