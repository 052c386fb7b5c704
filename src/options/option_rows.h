// The rows of the table of options, by theme. Private to the table.
#pragma once

#include <string_view>
#include <vector>

#include "regionmesh/options.h"

namespace regionmesh {

using Rows = std::vector<OptionSpec>;

inline constexpr std::uint32_t kSurfaceCommands = kDecimate | kRemesh | kSmooth | kCheck;
inline constexpr std::uint32_t kWriters = kReconstruct | kDecimate | kRemesh | kSmooth;
inline constexpr std::uint32_t kVolumeCommands = kReconstruct | kCheck | kInfo;
inline constexpr std::uint32_t kEveryCommand = 0xFFFFFFFFu;
inline constexpr std::uint32_t kSmoothers = kReconstruct | kSmooth;
inline constexpr std::uint32_t kDecimators = kReconstruct | kDecimate;
inline constexpr std::uint32_t kFinishers = kReconstruct | kDecimate | kRemesh;
inline constexpr std::uint32_t kAllCommands =
    kReconstruct | kDecimate | kRemesh | kSmooth | kCheck | kConvert | kCompare | kInfo | kVoxelise | kView;

// One function a group, in the order of help texts.
Rows argument_rows();
Rows volume_rows();  // selection_rows() among them
Rows selection_rows();
Rows tetrahedra_rows();
Rows label_rows();
Rows surface_rows();
Rows decimation_rows();
Rows smoothing_rows();
Rows validity_rows();
Rows comparison_rows();
Rows output_rows();
Rows run_rows();

/// "model to write: .vtp ...".
std::string_view written_help();
/// The same for convert, which writes folders, too.
std::string_view converted_help();

}  // namespace regionmesh
