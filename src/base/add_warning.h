// Warnings of readers, in one line.
#pragma once

#include <string>
#include <string_view>

namespace regionmesh {

/// Adds a sentence to a warning; either may be empty.
inline void add_warning(std::string& warning, std::string_view sentence) {
    if (!warning.empty() && !sentence.empty()) warning += "; ";
    warning += sentence;
}

}  // namespace regionmesh
