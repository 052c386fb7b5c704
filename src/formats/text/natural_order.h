// The order in which people number files.
#pragma once

#include <string_view>

namespace regionmesh::formats {

/// Compares runs of digits as numbers of any length, and other text byte by byte: s2 < s10. A total order: among names
/// that differ only in leading zeros, the one with fewer comes first.
bool natural_less(std::string_view a, std::string_view b);

}  // namespace regionmesh::formats
