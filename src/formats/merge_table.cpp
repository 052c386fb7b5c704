// Tables of labels to join.
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "formats/text/csv_rows.h"
#include "formats/text/header_text.h"
#include "regionmesh/error.h"
#include "regionmesh/read_sections.h"

namespace regionmesh {
namespace {

constexpr std::uint64_t kMostLabels = 1'000'000;  // of one row, and of all

/// "5" or "5-9"; a minus at the start is a sign.
std::optional<LabelRange> parse_labels(std::string_view text) {
    if (const auto label = formats::parse_table_label(text)) return LabelRange{*label, *label};
    const std::size_t dash = text.find('-', 1);
    if (dash == std::string_view::npos) return {};
    const auto first = formats::parse_label(formats::trim(text.substr(0, dash)));
    const auto last = formats::parse_label(formats::trim(text.substr(dash + 1)));
    if (!first || !last || *first > *last) return {};
    return LabelRange{*first, *last};
}

void add_row(const formats::CsvRows& rows, Selection& selection) {
    if (rows.field_count() < 2 || rows.field_count() > 3)
        rows.refuse(fmt::format("has {} columns; write 'old,new' or 'old,new,name'", rows.field_count()));
    const auto old_labels = parse_labels(rows.field(0));
    const auto new_label = formats::parse_table_label(rows.field(1));
    if (!old_labels)
        rows.refuse(
            fmt::format("'{}' is no label; write a whole number, or several as 5-9", formats::shown(rows.field(0))));
    if (!new_label) rows.refuse(fmt::format("'{}' is no label; write a whole number", formats::shown(rows.field(1))));
    const auto count = static_cast<std::uint64_t>(old_labels->last) - static_cast<std::uint64_t>(old_labels->first);
    if (count >= kMostLabels || selection.merge.size() + count >= kMostLabels)
        rows.refuse("the table has more than a million labels; write fewer");
    for (std::uint64_t n = 0; n <= count; ++n) {
        const auto label = static_cast<InputLabel>(static_cast<std::uint64_t>(old_labels->first) + n);
        const auto [known, is_new] = selection.merge.emplace(label, *new_label);
        if (!is_new && known->second != *new_label)
            rows.refuse(fmt::format("label {} becomes {} and {}; keep one", label, known->second, *new_label));
    }
    if (rows.field_count() < 3) return;
    const std::string name = formats::one_line(rows.field(2));
    if (name.empty()) return;
    const auto [known, is_new] = selection.names.emplace(*new_label, name);
    if (!is_new && known->second != name)
        rows.refuse(fmt::format("label {} is called '{}' and '{}'; keep one", *new_label, known->second, name));
}

}  // namespace

void read_merge_table(const std::filesystem::path& path, Selection& selection) {
    formats::CsvRows rows(path);
    for (bool is_first = true; rows.next(); is_first = false) {
        if (rows.field_count() > 0 && rows.field(0).starts_with('#')) continue;
        const bool is_header = is_first && rows.field_count() >= 2 && !parse_labels(rows.field(0)) &&
                               !formats::parse_table_label(rows.field(1));
        if (!is_header) add_row(rows, selection);
    }
    if (selection.merge.empty()) formats::fail(path, "holds no labels; write lines 'old,new,name'");
}

}  // namespace regionmesh
