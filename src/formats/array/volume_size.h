// The door: sizes, spacing and sweep of a volume, checked before anything is allocated.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>

#include "regionmesh/read_sections.h"

namespace regionmesh::formats {

inline constexpr std::uint64_t kMaxAxisSamples = (std::uint64_t{1} << 31) - 1;
inline constexpr std::uint64_t kMaxSectionSamples = std::uint64_t{1} << 31;

/// No deflate stream grows by more (zlib, "Maximum Expansion Factor"): a header that claims more lies, or was cut off.
inline constexpr std::uint64_t kMaxInflation = 1032;

/// The sizes along x, y, z as a lattice has them. Throws for an empty volume or an axis of 2^31 samples or more.
std::array<std::uint32_t, 3> checked_size(const std::filesystem::path& path, const std::array<std::uint64_t, 3>& size);

/// Bytes of all samples. Throws where they do not fit in 63 bits. Requires sizes from checked_size.
std::uint64_t volume_bytes(const std::filesystem::path& path, const std::array<std::uint32_t, 3>& size,
                           std::uint64_t sample_bytes);

/// What is known of a volume from its header; the sweep is along z until apply_options.
VolumeInfo volume_info(const std::filesystem::path& source, const char* format, SampleType type,
                       const std::array<std::uint32_t, 3>& size);

/// "5 x 4 x 3"
std::string size_text(const std::array<std::uint64_t, 3>& size);

/// Applies what the options say to `info`: spacing, and the sweep among those that can_sweep allows; kAuto takes the
/// one with the smallest section, z before y before x where they are equal. `remedy` ends the error for a sweep that is
/// not allowed. Throws also for sections of more than 2^31 samples, and for a layer other than 0: formats with layers
/// choose one before.
void apply_options(VolumeInfo& info, const ReadOptions& options, const std::string& remedy = "give --sweep z");

}  // namespace regionmesh::formats
