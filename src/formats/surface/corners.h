// What any tetrahedron of a mesh must have.
#pragma once

#include <array>
#include <cstdint>
#include <limits>

namespace regionmesh::formats {

/// Points are counted in 32 bits.
inline constexpr std::uint64_t kMostPoints = std::numeric_limits<std::uint32_t>::max();

inline bool has_repeated_corner(const std::array<std::uint32_t, 4>& c) {
    return c[0] == c[1] || c[0] == c[2] || c[0] == c[3] || c[1] == c[2] || c[1] == c[3] || c[2] == c[3];
}

}  // namespace regionmesh::formats
