// Bytes as text for messages.
#pragma once

#include <cstdint>
#include <string>

namespace regionmesh {

/// "12 MB": rounded up.
inline std::string megabytes(std::uint64_t bytes) { return std::to_string((bytes + 999'999) / 1'000'000) + " MB"; }

inline constexpr std::uint64_t kDefaultMemory = std::uint64_t{2} << 30;

/// "--memory 12 MB", the limit in a refusal; says so where it is the default.
inline std::string memory_limit_text(std::uint64_t bytes) {
    return "--memory " + megabytes(bytes) + (bytes == kDefaultMemory ? " (the default)" : "");
}

}  // namespace regionmesh
