// The commands: one function, in a file of its own, for each row of command_table().
#pragma once

#include "regionmesh/options.h"

namespace regionmesh::cli {

/// Exit codes.
inline constexpr int kGood = 0, kBadInput = 1, kBadUsage = 2, kViolations = 3, kNotMet = 4;

// Each runs a command and returns kGood, kViolations where the model has some, or kNotMet where it
// is sound but regions are off the volumes that --preserve-volume asks for.
int run_reconstruct(const Settings& settings);
int run_decimate(const Settings& settings);
int run_remesh(const Settings& settings);
int run_smooth(const Settings& settings);
int run_check(const Settings& settings);
int run_convert(const Settings& settings);
int run_compare(const Settings& settings);
int run_info(const Settings& settings);
int run_voxelise(const Settings& settings);
int run_view(const Settings& settings);

}  // namespace regionmesh::cli
