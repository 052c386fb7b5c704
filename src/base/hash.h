// Hashes of integers, for hash tables and for breaking ties by the input alone.
#pragma once

#include <cstdint>

namespace regionmesh {

/// The finalizer of SplitMix64 (Steele, Lea, Flood 2014): a bijection in which every input bit reaches every output
/// bit.
constexpr std::uint64_t mix64(std::uint64_t x) {
    x += 0x9E3779B97F4A7C15ull;
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9ull;
    x = (x ^ (x >> 27)) * 0x94D049BB133111EBull;
    return x ^ (x >> 31);
}

/// A number in [0, 1) from the hash of a pair; the order of the pair does not matter.
inline double hash_unit(std::uint32_t a, std::uint32_t b) {
    const std::uint64_t low = a < b ? a : b;
    const std::uint64_t high = a < b ? b : a;
    return static_cast<double>(mix64(high << 32 | low) >> 11) * 0x1p-53;
}

}  // namespace regionmesh
