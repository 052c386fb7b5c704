// What tables with the names and tables with the colours of labels have in common.
#pragma once

#include <cctype>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "formats/text/header_text.h"

namespace regionmesh::formats {

/// Larger files, and rows with more columns, are no tables of labels.
inline constexpr std::uint64_t kMostTableBytes = std::uint64_t{4} << 20;
inline constexpr std::size_t kMostTableColumns = 1000;

/// Titles of the column of labels, as column_titled() has them.
inline constexpr std::string_view kLabelTitles[]{"label", "labelvalue", "labelid", "index", "value",
                                                 "id",    "key",        "number",  "roi",   "no"};

inline bool is_label(std::string_view text) { return parse_table_label(text).has_value(); }

/// Of a line without blanks round it.
inline bool is_comment(std::string_view line) {
    return line.starts_with('#') || line.starts_with('%') || line.starts_with("//");
}

/// The first column that `is_wanted` whose title is the earliest possible of `titles`: letters and digits count,
/// capitals do not.
template <class IsWanted>
std::optional<std::size_t> column_titled(std::span<const std::string> header, std::span<const std::string_view> titles,
                                         IsWanted&& is_wanted) {
    for (const std::string_view title : titles)
        for (std::size_t column = 0; column < header.size(); ++column) {
            std::string plain = lower(header[column]);
            std::erase_if(plain, [](unsigned char c) { return !std::isalnum(c); });
            if (plain == title && is_wanted(column)) return column;
        }
    return {};
}

}  // namespace regionmesh::formats
