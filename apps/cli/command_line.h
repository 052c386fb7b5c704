// The command line, built from the table of options.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

#include "regionmesh/options.h"

namespace regionmesh::cli {

/// Runs a command and returns its exit code.
using Action = std::function<int()>;

/// Adds a command with its arguments and options. Where the command is chosen, `action` becomes the call of `run` with
/// the settings; that call throws Error(kUsage) for bad values. `has_config`: what the command needs may stand in the
/// file of --config.
void add_command(CLI::App& app, const CommandSpec& command, int (*run)(const Settings&), bool has_config,
                 Action& action);

}  // namespace regionmesh::cli
