// What is read of one image file; registry.cpp has the rows. Sections are numbered for error messages.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

#include "formats/images/image_shape.h"

namespace regionmesh::formats {

/// Size and type from the header alone.
using ReadShape = ImageShape(const std::filesystem::path& path, std::uint64_t section);

/// The labels of the image, rows from the top. Throws Error(kInput) where it is not like `expected`, damaged or cut
/// short; messages of the image library become part of the error, and nothing is printed.
using ReadImage = void(const std::filesystem::path& path, std::uint64_t section, const ImageShape& expected,
                       std::span<InputLabel> labels);

ReadShape read_png_shape, read_tiff_shape;
ReadImage read_png_image, read_tiff_image;  // a TIFF file of one page

}  // namespace regionmesh::formats
