// Bytes as text for messages.
#pragma once

#include <cstdint>
#include <string>

#include "regionmesh/limits.h"

namespace regionmesh {

/// The program and its libraries, and buffers of reading and writing.
inline constexpr std::uint64_t kProcessBytes = std::uint64_t{20} << 20;

/// The bytes in a megabyte, or in a kilobyte where there are fewer.
inline std::uint64_t unit_of(std::uint64_t bytes) { return bytes < 1'000'000 ? 1000 : 1'000'000; }

/// "12 MB", or "12 kB" below one: rounded up.
inline std::string megabytes(std::uint64_t bytes) {
    const std::uint64_t unit = unit_of(bytes);
    return std::to_string((bytes + unit - 1) / unit) + (unit == 1000 ? " kB" : " MB");
}

/// "--memory 12 MB", the limit in a refusal, rounded down, so that what is needed is more; says so where it is the
/// default.
inline std::string memory_limit_text(std::uint64_t bytes) {
    return "--memory " + megabytes(bytes - bytes % unit_of(bytes)) + (bytes == kDefaultMemory ? " (the default)" : "");
}

}  // namespace regionmesh
