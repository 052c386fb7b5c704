// What one image file must have in common with its neighbours, and how its pixels become labels.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "regionmesh/section_reader.h"

namespace regionmesh::formats {

/// Pixels are never converted: a palette is not looked up, 1-bit images give 0 and 1 as stored (also where the format
/// shows 0 as white), and pixels of several channels become one integer, in which the first colour stands highest and
/// alpha above all: a << 24 | r << 16 | g << 8 | b where channels have 8 bits.
struct ImageShape {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    int channels = 1;  // alpha too
    int bits = 8;      // of one channel
    bool is_signed = false;
    bool is_palette = false;

    friend bool operator==(const ImageShape&, const ImageShape&) = default;
};

/// The type that holds a label of such pixels.
SampleType label_type(const ImageShape& shape);

/// "640 x 480 uint8", "640 x 480 uint8 palette", "640 x 480 4 x uint16".
std::string describe(const ImageShape& shape);

/// Throws for an empty image, more than 2^31 pixels, or channels that are not read: 1, 2, 4, 8, 16, 32 or 64 bits
/// alone, 8 or 16 bits in twos to fours.
void check_shape(const std::filesystem::path& path, std::uint64_t section, const ImageShape& shape);

/// Throws, naming both, where a section is not like the first one.
void check_same_shape(const std::filesystem::path& path, std::uint64_t section, const ImageShape& shape,
                      const ImageShape& first);

/// The channels that a row of stored samples holds: all of a pixel beside each other, or one alone.
struct RowFormat {
    int first_channel = 0;
    int channel_count = 1;
    bool is_big_endian = false;
};

/// Turns a row of samples as stored (bits packed from the highest down) into labels. Channels of pixels with several
/// are or-ed into `labels`, which must be 0 before the first of them.
void unpack_row(std::span<const std::byte> row, const ImageShape& shape, RowFormat format,
                std::span<InputLabel> labels);

}  // namespace regionmesh::formats
