// The order in which people number files.
#pragma once

#include <string_view>

namespace regionmesh::formats {

/// Compares runs of digits as numbers, of any length, and all else byte by byte: s2 < s10. Total: names that differ
/// only in leading zeros have the one with fewer first.
bool natural_less(std::string_view a, std::string_view b);

}  // namespace regionmesh::formats
