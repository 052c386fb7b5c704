#include "formats/codec/sample_format.h"

#include <array>
#include <limits>
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

NumberType number_type(SampleType type) {
    return type == SampleType::kU1
               ? NumberType::kUint8
               : static_cast<NumberType>(static_cast<int>(type) - static_cast<int>(SampleType::kI8));
}

SampleType sample_type(NumberType integer) {
    return static_cast<SampleType>(static_cast<int>(integer) + static_cast<int>(SampleType::kI8));
}

std::size_t sample_bytes(SampleType type) { return bytes_of(number_type(type)); }

SampleRange range_of(SampleType type) {
    const std::uint64_t all = std::numeric_limits<std::uint64_t>::max() >> (64 - 8 * sample_bytes(type));
    switch (type) {
        case SampleType::kI8:
        case SampleType::kI16:
        case SampleType::kI32:
        case SampleType::kI64:
            return {-static_cast<std::int64_t>(all / 2) - 1, all / 2};
        default:
            return {0, all};
    }
}

void decode_samples(const std::byte* bytes, std::size_t pitch, SampleFormat format, std::span<InputLabel> labels) {
    load_all(bytes, pitch, number_type(format.type), format.is_big_endian, labels);
    if (format.type == SampleType::kU1)
        for (InputLabel& label : labels) label = label != 0;
}

}  // namespace formats
}  // namespace regionmesh
