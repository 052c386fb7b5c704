// Samples of frames as DICOM stores them, turned into labels.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "regionmesh/label.h"

namespace regionmesh::formats {

/// Gives `label` to the samples whose bit is set: 8 in a byte, the first in the lowest bit. Bits beyond the section are
/// ignored: they come from another process.
void set_label(std::span<const std::byte> packed, InputLabel label, std::span<InputLabel> section);

/// Copies samples of 8 bits, or of 16 in the byte order of this machine. Requires as many as the section has.
void copy_labels(std::span<const std::byte> stored, std::uint32_t bits, std::span<InputLabel> section);

}  // namespace regionmesh::formats
