// One function per command; each adds its options to the program and leaves what to run.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace regionmesh::cli {

/// Runs a command and returns its exit code: 0 good, 3 check found violations.
using Action = std::function<int()>;

void add_reconstruct(CLI::App& app, Action& action);
void add_decimate(CLI::App& app, Action& action);
void add_smooth(CLI::App& app, Action& action);
void add_check(CLI::App& app, Action& action);
void add_convert(CLI::App& app, Action& action);
void add_compare(CLI::App& app, Action& action);
void add_info(CLI::App& app, Action& action);
void add_voxelise(CLI::App& app, Action& action);

}  // namespace regionmesh::cli
