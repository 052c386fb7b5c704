// Numbers in as few bytes as they need: seven bits a byte, the lowest first.
#pragma once

#include <cstdint>
#include <vector>

namespace regionmesh {

using PackedBytes = std::vector<std::uint8_t>;

inline void put_number(PackedBytes& to, std::uint64_t number) {
    for (; number >= 128; number >>= 7) to.push_back(static_cast<std::uint8_t>(number | 128));
    to.push_back(static_cast<std::uint8_t>(number));
}
/// Reads what put_number() wrote, and moves on to what follows.
inline std::uint64_t take_number(const std::uint8_t*& from) {
    std::uint64_t number = *from & 127;
    for (int shift = 7; *from++ & 128; shift += 7) number |= std::uint64_t{*from & 127u} << shift;
    return number;
}

/// 0, -1, 1, -2, 2, ... become 0, 1, 2, 3, 4, ...: numbers near zero need few bytes.
constexpr std::uint64_t folded(std::int64_t number) {
    return static_cast<std::uint64_t>(number) << 1 ^ static_cast<std::uint64_t>(number >> 63);
}
constexpr std::int64_t unfolded(std::uint64_t number) {
    return static_cast<std::int64_t>(number >> 1) ^ -static_cast<std::int64_t>(number & 1);
}

}  // namespace regionmesh
