// Checks size, spacing and sweep of a volume before anything is allocated.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>

#include "formats/codec/sample_format.h"
#include "regionmesh/read_sections.h"

namespace regionmesh::formats {

inline constexpr std::uint64_t kMaxAxisSamples = (std::uint64_t{1} << 31) - 1;
inline constexpr std::uint64_t kMaxSectionSamples = std::uint64_t{1} << 31;

/// Largest ratio of inflated to deflated bytes (zlib, "Maximum Expansion Factor").
inline constexpr std::uint64_t kMaxInflation = 1032;

/// The size along x, y, z. Throws for an empty volume or an axis of 2^31 samples or more.
std::array<std::uint32_t, 3> checked_size(const std::filesystem::path& path, const std::array<std::uint64_t, 3>& size);

/// Bytes of all samples. Throws if the number does not fit in 63 bits. Requires sizes from checked_size.
std::uint64_t volume_bytes(const std::filesystem::path& path, const std::array<std::uint32_t, 3>& size,
                           std::uint64_t sample_bytes);

/// A description with default lattice but for the size; the sweep is along z until apply_options sets it.
VolumeInfo volume_info(const std::filesystem::path& source, const std::string& format, SampleType type,
                       const std::array<std::uint32_t, 3>& size);

/// Where the options make labels of reals: has samples of the format read as ordered_label(). Sets `info` alike.
void order_reals(const ReadOptions& options, SampleFormat& format, VolumeInfo& info);

/// The options without --layer, for a format that has followed it.
ReadOptions without_choice(const ReadOptions& options);

/// "5 x 4 x 3"
std::string size_text(const std::array<std::uint64_t, 3>& size);

/// Sets spacing and sweep of `info` as the options say. kAuto chooses the allowed sweep with the smallest section; if
/// equal, z before y before x. `remedy` ends the error for a sweep that can_sweep forbids. Throws also for sections of
/// more than 2^31 samples, and for a layer other than 0: formats with layers choose the layer before.
void apply_options(VolumeInfo& info, const ReadOptions& options, const std::string& remedy = "give --sweep z");

}  // namespace regionmesh::formats
