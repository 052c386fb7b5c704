// Bytes as text for messages.
#pragma once

#include <cstdint>
#include <string>

namespace regionmesh {

/// "12 MB", or "12 kB" below one: rounded up.
inline std::string megabytes(std::uint64_t bytes) {
    if (bytes < 1'000'000) return std::to_string((bytes + 999) / 1000) + " kB";
    return std::to_string((bytes + 999'999) / 1'000'000) + " MB";
}

inline constexpr std::uint64_t kDefaultMemory = std::uint64_t{2} << 30;

/// "--memory 12 MB", the limit in a refusal, rounded down, so that what is needed is more; says so where it is the
/// default.
inline std::string memory_limit_text(std::uint64_t bytes) {
    const std::string text =
        bytes < 1'000'000 ? std::to_string(bytes / 1000) + " kB" : std::to_string(bytes / 1'000'000) + " MB";
    return "--memory " + text + (bytes == kDefaultMemory ? " (the default)" : "");
}

}  // namespace regionmesh
