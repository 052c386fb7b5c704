#include "formats/codec/sample_format.h"

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <utility>

#include "regionmesh/read_sections.h"

namespace regionmesh {
namespace {

constexpr std::array<std::pair<SampleType, const char*>, 9> kWords{{
    {SampleType::kU1, "bool"},
    {SampleType::kI8, "int8"},
    {SampleType::kU8, "uint8"},
    {SampleType::kI16, "int16"},
    {SampleType::kU16, "uint16"},
    {SampleType::kI32, "int32"},
    {SampleType::kU32, "uint32"},
    {SampleType::kI64, "int64"},
    {SampleType::kU64, "uint64"},
}};

}  // namespace

std::string to_string(SampleType type) {
    for (const auto& [known, word] : kWords) {
        if (known == type) return word;
    }
    return "unknown";
}

std::optional<SampleType> parse_sample_type(const std::string& word) {
    for (const auto& [type, known] : kWords) {
        if (known == word) return type;
    }
    return std::nullopt;
}

namespace formats {
namespace {

template <class Sample>
Sample swap_bytes(Sample sample) {
    if constexpr (sizeof(Sample) == 2)
        return static_cast<Sample>(__builtin_bswap16(static_cast<std::uint16_t>(sample)));
    if constexpr (sizeof(Sample) == 4)
        return static_cast<Sample>(__builtin_bswap32(static_cast<std::uint32_t>(sample)));
    if constexpr (sizeof(Sample) == 8)
        return static_cast<Sample>(__builtin_bswap64(static_cast<std::uint64_t>(sample)));
    return sample;
}

template <class Sample, bool kSwap>
void decode_run(const std::byte* bytes, std::size_t pitch, std::span<InputLabel> labels) {
    for (InputLabel& label : labels) {
        Sample sample;
        std::memcpy(&sample, bytes, sizeof sample);
        if constexpr (kSwap) sample = swap_bytes(sample);
        label = static_cast<InputLabel>(sample);
        bytes += pitch;
    }
}

template <class Sample>
void decode_as(const std::byte* bytes, std::size_t pitch, bool is_big_endian, std::span<InputLabel> labels) {
    if (is_big_endian == (std::endian::native == std::endian::big)) {
        decode_run<Sample, false>(bytes, pitch, labels);
    } else {
        decode_run<Sample, true>(bytes, pitch, labels);
    }
}

}  // namespace

std::size_t sample_bytes(SampleType type) {
    switch (type) {
        case SampleType::kU1:
        case SampleType::kI8:
        case SampleType::kU8:
            return 1;
        case SampleType::kI16:
        case SampleType::kU16:
            return 2;
        case SampleType::kI32:
        case SampleType::kU32:
            return 4;
        case SampleType::kI64:
        case SampleType::kU64:
            return 8;
    }
    return 1;
}

void decode_samples(const std::byte* bytes, std::size_t pitch, SampleFormat format, std::span<InputLabel> labels) {
    switch (format.type) {
        case SampleType::kU1:
            decode_run<std::uint8_t, false>(bytes, pitch, labels);
            for (InputLabel& label : labels) label = label != 0;
            return;
        case SampleType::kI8:
            return decode_run<std::int8_t, false>(bytes, pitch, labels);
        case SampleType::kU8:
            return decode_run<std::uint8_t, false>(bytes, pitch, labels);
        case SampleType::kI16:
            return decode_as<std::int16_t>(bytes, pitch, format.is_big_endian, labels);
        case SampleType::kU16:
            return decode_as<std::uint16_t>(bytes, pitch, format.is_big_endian, labels);
        case SampleType::kI32:
            return decode_as<std::int32_t>(bytes, pitch, format.is_big_endian, labels);
        case SampleType::kU32:
            return decode_as<std::uint32_t>(bytes, pitch, format.is_big_endian, labels);
        case SampleType::kI64:
            return decode_as<std::int64_t>(bytes, pitch, format.is_big_endian, labels);
        case SampleType::kU64:
            return decode_as<std::uint64_t>(bytes, pitch, format.is_big_endian, labels);
    }
}

}  // namespace formats
}  // namespace regionmesh
