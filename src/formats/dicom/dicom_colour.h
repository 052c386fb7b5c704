// Colours as DICOM writes them.
#pragma once

#include <array>
#include <cstdint>

namespace regionmesh::formats {

/// sRGB, 0xRRGGBB, of a RecommendedDisplayCIELabValue (DICOM PS3.3 C.10.7.1.1): L* from 0 to 100, a* and b* from -128
/// to 127, each stored as 0 to 65535. The white is D65, as writers of segmentations have it (DCMTK, dcmqi), although
/// the standard says D50. Colours outside sRGB are clipped.
std::uint32_t colour_of_lab(const std::array<std::uint16_t, 3>& stored);

/// sRGB, 0xRRGGBB, of red, green and blue in 16 bits.
std::uint32_t colour_of_palette(const std::array<std::uint16_t, 3>& stored);

}  // namespace regionmesh::formats
