#include "formats/images/image_shape.h"

#include <fmt/format.h>

#include <cassert>

#include "formats/array/volume_size.h"
#include "formats/codec/sample_format.h"
#include "formats/input_file.h"
#include "regionmesh/read_sections.h"

namespace regionmesh::formats {
namespace {

/// The smallest unsigned type of `bits`.
SampleType unsigned_type(int bits) {
    if (bits == 1) return SampleType::kU1;
    if (bits <= 8) return SampleType::kU8;
    if (bits <= 16) return SampleType::kU16;
    return bits <= 32 ? SampleType::kU32 : SampleType::kU64;
}

SampleType channel_type(const ImageShape& shape) {
    if (shape.is_real) return SampleType::kI64;
    if (!shape.is_signed) return unsigned_type(shape.bits);
    if (shape.bits <= 8) return SampleType::kI8;
    if (shape.bits <= 16) return SampleType::kI16;
    return shape.bits <= 32 ? SampleType::kI32 : SampleType::kI64;
}

bool has_alpha(const ImageShape& shape) { return shape.channels % 2 == 0; }

/// The shift of a channel in the label. Alpha is the last of two or four channels.
int channel_shift(const ImageShape& shape, int channel) {
    const int colours = shape.channels - (has_alpha(shape) ? 1 : 0);
    return shape.bits * (channel < colours ? colours - 1 - channel : colours);
}

void unpack_bits(std::span<const std::byte> row, int bits, std::span<InputLabel> labels) {
    const unsigned mask = (1u << bits) - 1;
    const int per_byte = 8 / bits;
    for (std::size_t x = 0; x < labels.size(); ++x) {
        const int place = static_cast<int>(x % per_byte);
        labels[x] = std::to_integer<unsigned>(row[x / per_byte]) >> (8 - bits * (place + 1)) & mask;
    }
}

void or_channels(std::span<const std::byte> row, const ImageShape& shape, RowFormat format,
                 std::span<InputLabel> labels) {
    const bool is_wide = shape.bits == 16;
    const std::size_t bytes = is_wide ? 2 : 1;
    const std::size_t high = format.is_big_endian ? 0 : 1;
    const std::byte* at = row.data();
    for (InputLabel& label : labels) {
        auto packed = static_cast<std::uint64_t>(label);
        for (int channel = 0; channel < format.channel_count; ++channel, at += bytes) {
            std::uint64_t value = std::to_integer<std::uint64_t>(at[0]);
            if (is_wide)
                value = std::to_integer<std::uint64_t>(at[high]) << 8 | std::to_integer<std::uint64_t>(at[1 - high]);
            packed |= value << channel_shift(shape, format.first_channel + channel);
        }
        label = static_cast<InputLabel>(packed);
    }
}

}  // namespace

SampleType label_type(const ImageShape& shape) {
    return shape.channels == 1 ? channel_type(shape) : unsigned_type(shape.channels * shape.bits);
}

std::string warning_of_alpha(const ImageShape& shape) {
    if (!has_alpha(shape)) return {};
    const std::uint64_t opaque = ((std::uint64_t{1} << shape.bits) - 1) << channel_shift(shape, shape.channels - 1);
    return "pixels have alpha, which stands above their colour in the label: opaque black is " +
           std::to_string(opaque) + ", not 0; --background names it";
}

std::string describe(const ImageShape& shape) {
    std::string text = std::to_string(shape.width) + " x " + std::to_string(shape.height) + " ";
    if (shape.channels > 1) text += std::to_string(shape.channels) + " x ";
    if (shape.is_real) return text + "float" + std::to_string(shape.bits);
    text += shape.bits == 2 || shape.bits == 4 ? std::to_string(shape.bits) + "-bit" : to_string(channel_type(shape));
    if (shape.is_palette) text += " palette";
    return text;
}

void check_shape(const std::filesystem::path& path, std::uint64_t section, const ImageShape& shape) {
    const std::uint64_t pixels = std::uint64_t{shape.width} * shape.height;
    if (pixels == 0) fail_section(path, section, "empty volume: the image is " + describe(shape) + "; remove it");
    if (pixels > kMaxSectionSamples || shape.width > kMaxAxisSamples || shape.height > kMaxAxisSamples) {
        fail_section(path, section, "the image is " + describe(shape) + ", more than 2^31 pixels; crop it");
    }
    const auto is_one_of = [](int value, std::initializer_list<int> list) {
        for (const int item : list) {
            if (item == value) return true;
        }
        return false;
    };
    const bool is_read =
        shape.is_real ? shape.channels == 1 && is_one_of(shape.bits, {32, 64})
        : shape.channels == 1
            ? is_one_of(shape.bits, {8, 16, 32, 64}) || (!shape.is_signed && is_one_of(shape.bits, {1, 2, 4}))
            : is_one_of(shape.channels, {2, 3, 4}) && is_one_of(shape.bits, {8, 16}) && !shape.is_signed;
    if (!is_read) {
        fail_section(path, section,
                     "pixels have " + std::to_string(shape.channels) + " channels of " + std::to_string(shape.bits) +
                         (shape.is_real     ? " float"
                          : shape.is_signed ? " signed"
                                            : "") +
                         " bits, which is not read; convert to 8 or 16 bit gray");
    }
}

void check_same_shape(const std::filesystem::path& path, std::uint64_t section, const ImageShape& shape,
                      const ImageShape& first) {
    if (shape == first) return;
    fail_section(path, section,
                 "the image is " + describe(shape) + " where section 0 is " + describe(first) +
                     "; give sections of one size and type");
}

void require_labels(const std::filesystem::path& path, std::uint64_t section, const std::optional<NoLabel>& problem,
                    std::uint64_t column, std::uint64_t row) {
    if (problem)
        fail_section(path, section,
                     fmt::format("pixel ({}, {}) {}", column + problem->index, row, why_no_label(problem->value)));
}

std::optional<NoLabel> unpack_row(std::span<const std::byte> row, const ImageShape& shape, RowFormat format,
                                  std::span<InputLabel> labels) {
    assert(row.size() * 8 >= labels.size() * shape.bits * format.channel_count);
    if (shape.channels > 1) {
        or_channels(row, shape, format, labels);
    } else if (shape.bits < 8) {
        unpack_bits(row, shape.bits, labels);
    } else {
        SampleFormat sample{channel_type(shape), format.is_big_endian};
        if (shape.is_real) sample.real = shape.bits == 32 ? NumberType::kFloat32 : NumberType::kFloat64;
        return decode_samples(row.data(), sample_bytes(sample), sample, labels);
    }
    return std::nullopt;
}

}  // namespace regionmesh::formats
