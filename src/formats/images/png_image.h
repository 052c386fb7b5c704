// One PNG file, by libpng.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

#include "formats/images/image_shape.h"

namespace regionmesh::formats {

/// Size and type from the header alone. `section` is for the error messages.
ImageShape read_png_shape(const std::filesystem::path& path, std::uint64_t section);

/// The labels of the image, rows from the top. Throws where it is not like `expected`, or damaged, or cut short: what
/// libpng says becomes part of an Error, and nothing is printed.
void read_png(const std::filesystem::path& path, std::uint64_t section, const ImageShape& expected,
              std::span<InputLabel> labels);

}  // namespace regionmesh::formats
