// Cells of CSV tables.
#pragma once

#include <string>

namespace regionmesh {

/// In quotes where the text has a separator, a quote or a line end (RFC 4180).
inline std::string csv_cell(const std::string& text) {
    if (text.find_first_of(",\"\r\n;") == std::string::npos) return text;
    std::string all = "\"";
    for (const char c : text) all += c == '"' ? std::string("\"\"") : std::string(1, c);
    return all + '"';
}

}  // namespace regionmesh
