// Numbers of any type and byte order, as binary files store them.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

namespace regionmesh::formats {

enum class NumberType { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kInt64, kUint64, kFloat32, kFloat64 };

constexpr bool is_real(NumberType type) { return type >= NumberType::kFloat32; }
std::size_t bytes_of(NumberType type);

/// One number of type T; `bytes` need not be aligned.
template <class T>
T load(const void* bytes, bool is_big_endian) {
    std::byte copy[sizeof(T)];
    std::memcpy(copy, bytes, sizeof(T));
    if (is_big_endian != (std::endian::native == std::endian::big)) std::reverse(copy, copy + sizeof(T));
    T number;
    std::memcpy(&number, copy, sizeof(T));
    return number;
}

/// Converts numbers that begin `pitch` bytes apart to To (std::int64_t or double). Integers keep their sign, and as
/// std::int64_t unsigned ones of 64 bits keep their bits. Reals as std::int64_t must be in range.
template <class To>
void load_all(const std::byte* bytes, std::size_t pitch, NumberType type, bool is_big_endian, std::span<To> numbers);

}  // namespace regionmesh::formats
