// What is read of one image file; registry.cpp has the rows. Sections are numbered for error messages.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

#include "formats/images/image_shape.h"

namespace regionmesh::formats {

/// Size and type from the header alone.
using ReadShape = ImageShape(const std::filesystem::path& path, std::uint64_t section);

/// Whether a window of the image is read without the pixels far from it: those of other tiles.
using IsTiled = bool(const std::filesystem::path& path, std::uint64_t section);

/// The labels of a window of an image that is tiled, rows from the top. Throws like ReadImage.
using ReadWindow = void(const std::filesystem::path& path, std::uint64_t section, const ImageShape& expected,
                        const ImageWindow& window, std::span<InputLabel> labels);

/// The labels of the image, rows from the top. Throws Error(kInput) where it is not like `expected`, damaged or cut
/// short; messages of the image library become part of the error, and nothing is printed.
using ReadImage = void(const std::filesystem::path& path, std::uint64_t section, const ImageShape& expected,
                       std::span<InputLabel> labels);

ReadShape read_png_shape, read_tiff_shape;
ReadImage read_png_image, read_tiff_image;  // a TIFF file of one page

IsTiled is_tiled_tiff;
ReadWindow read_tiff_window;

}  // namespace regionmesh::formats
