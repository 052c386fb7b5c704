// Bytes as text for messages.
#pragma once

#include <cstdint>
#include <string>

namespace regionmesh {

/// "12 MB": rounded up.
inline std::string megabytes(std::uint64_t bytes) { return std::to_string((bytes + 999'999) / 1'000'000) + " MB"; }

}  // namespace regionmesh
