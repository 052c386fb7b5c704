// The size and type that all sections share, and the decoding of pixels to labels.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "formats/codec/sample_format.h"
#include "regionmesh/section_reader.h"

namespace regionmesh::formats {

/// Pixels are never converted: palettes are not applied, 1-bit images give 0 and 1 as stored (even if the format
/// displays 0 as white), and the channels of a pixel become one integer, with the first colour above the others and
/// alpha above all: a << 24 | r << 16 | g << 8 | b for channels of 8 bits.
struct ImageShape {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    int channels = 1;  // including alpha
    int bits = 8;      // of one channel
    bool is_signed = false;
    bool is_palette = false;
    bool is_real = false;

    friend bool operator==(const ImageShape&, const ImageShape&) = default;
};

/// Pixels of an image: columns and rows from `low` to before `high`.
struct ImageWindow {
    std::array<std::uint32_t, 2> low{}, high{};

    std::uint32_t width() const { return high[0] - low[0]; }
    std::uint32_t height() const { return high[1] - low[1]; }
};
inline ImageWindow window_of(const IndexBox& box) { return {{box.low[0], box.low[1]}, {box.high[0], box.high[1]}}; }

/// The type of the labels.
SampleType label_type(const ImageShape& shape);

/// What VolumeInfo::warning says of images with alpha; empty for others.
std::string warning_of_alpha(const ImageShape& shape);

/// "640 x 480 uint8", "640 x 480 uint8 palette", "640 x 480 4 x uint16".
std::string describe(const ImageShape& shape);

/// Throws where a pixel is no label.
void require_labels(const std::filesystem::path& path, std::uint64_t section, const std::optional<NoLabel>& problem,
                    std::uint64_t column, std::uint64_t row);

/// Throws for an empty image, more than 2^31 pixels, or channels that are not read. Read are one channel of 1, 2, 4, 8,
/// 16, 32 or 64 bits, and two to four channels of 8 or 16 bits.
void check_shape(const std::filesystem::path& path, std::uint64_t section, const ImageShape& shape);

/// Throws if a section differs from the first one; the error describes both.
void check_same_shape(const std::filesystem::path& path, std::uint64_t section, const ImageShape& shape,
                      const ImageShape& first);

/// The channels in a row of stored samples: all channels of each pixel, or one.
struct RowFormat {
    int first_channel = 0;
    int channel_count = 1;
    bool is_big_endian = false;
};

/// Decodes a row of stored samples (bits packed from the highest down) to labels. Several channels are or-ed into
/// `labels`, which must be 0 before the first channel. Returns the first real that is no label.
std::optional<NoLabel> unpack_row(std::span<const std::byte> row, const ImageShape& shape, RowFormat format,
                                  std::span<InputLabel> labels);

}  // namespace regionmesh::formats
