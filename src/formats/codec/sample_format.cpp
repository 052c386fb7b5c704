#include "formats/codec/sample_format.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
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

std::size_t sample_bytes(const SampleFormat& format) {
    return format.real ? bytes_of(*format.real) : sample_bytes(format.type);
}

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

SampleType label_type(const SampleFormat& format) {
    return format.is_real() || format.is_ordered ? SampleType::kI64 : format.type;
}

SampleFormat real_format(NumberType real, bool is_big_endian) {
    SampleFormat format{.type = SampleType::kI64, .is_big_endian = is_big_endian};
    format.real = real;
    return format;
}

InputLabel ordered_label(double value) {
    if (std::isnan(value)) return std::numeric_limits<InputLabel>::min();
    const auto bits = std::bit_cast<std::int64_t>(value + 0.0);  // -0 becomes 0
    return bits >= 0 ? bits : bits ^ std::numeric_limits<std::int64_t>::max();
}

std::string why_no_label(double value) {
    return fmt::format(
        "is {:.9g}, and labels are whole numbers; give --threshold V for grey values or shares, or round the labels",
        value);
}

namespace {

/// The label of a real. `size` is the sum of the sizes of what it was computed from, which are rounded.
std::optional<InputLabel> label_of(double value, double size, const SampleFormat& format) {
    if (format.is_ordered) return ordered_label(value);
    constexpr double kLimit = 9007199254740992;               // 2^53
    constexpr double kRounding = 1e-6, kMostRounding = 1e-2;  // scales are often in single precision
    const bool is_scaled = format.slope != 1 || format.intercept != 0;
    const double whole = std::round(value), bound = is_scaled ? std::min(kRounding * size, kMostRounding) : 0;
    if (!(std::abs(value) < kLimit) || std::abs(value - whole) > bound) return std::nullopt;
    return static_cast<InputLabel>(whole);
}

std::optional<NoLabel> decode_reals(const std::byte* bytes, std::size_t pitch, const SampleFormat& format,
                                    std::span<InputLabel> labels) {
    constexpr std::size_t kPart = 512;
    std::array<double, kPart> reals;
    const NumberType stored = format.real.value_or(number_type(format.type));
    double last = 0;
    std::optional<InputLabel> label = label_of(format.intercept, 0, format);
    double last_value = format.intercept;
    for (std::size_t done = 0; done < labels.size(); done += kPart) {
        const auto part = std::span(reals).first(std::min(kPart, labels.size() - done));
        load_all(bytes + done * pitch, pitch, stored, format.is_big_endian, part);
        for (std::size_t n = 0; n < part.size(); ++n) {
            if (!(part[n] == last) || !label) {
                last = part[n];
                last_value = format.slope * last + format.intercept;
                label = label_of(last_value, std::abs(format.slope * last) + std::abs(format.intercept), format);
                if (!label) return NoLabel{done + n, last_value};
            }
            labels[done + n] = *label;
        }
    }
    return std::nullopt;
}

}  // namespace

std::optional<NoLabel> decode_samples(const std::byte* bytes, std::size_t pitch, const SampleFormat& format,
                                      std::span<InputLabel> labels) {
    if (format.is_real() || format.is_ordered) return decode_reals(bytes, pitch, format, labels);
    load_all(bytes, pitch, number_type(format.type), format.is_big_endian, labels);
    if (format.type == SampleType::kU1)
        for (InputLabel& label : labels) label = label != 0;
    return std::nullopt;
}

}  // namespace formats
}  // namespace regionmesh
