// The header of our PLY files, word for word: the writer puts it together from these, the reader expects them.
#pragma once

#include <cstddef>
#include <string_view>

namespace regionmesh {

inline constexpr std::string_view kPlyMagic = "ply\nformat binary_little_endian 1.0\n";
inline constexpr std::string_view kPlyVertex =
    "property double x\nproperty double y\nproperty double z\nproperty uchar node_type\n";
inline constexpr std::string_view kPlyFace = "property list uchar uint vertex_indices\n";

/// Labels that fit 32 bits with their sign.
inline constexpr std::string_view kPlyLabels = "property int label_first\nproperty int label_second\n";

/// Other labels as two words each: PLY has no integers of 64 bits.
inline constexpr std::string_view kPlyWideLabels =
    "property uint label_first_low\nproperty uint label_first_high\nproperty uint label_second_low\nproperty uint "
    "label_second_high\n";

inline constexpr std::size_t kPlyVertexBytes = 3 * 8 + 1;
inline constexpr std::size_t kPlyFaceBytes = 1 + 3 * 4 + 2 * 4;
inline constexpr std::size_t kPlyWideFaceBytes = kPlyFaceBytes + 2 * 4;

}  // namespace regionmesh
