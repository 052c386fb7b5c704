// The command line, built from the table of options.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

#include "regionmesh/options.h"

namespace regionmesh::cli {

/// Runs a command and returns its exit code.
using Action = std::function<int()>;

/// What the arguments say before they are parsed.
struct Typed {
    bool has_config = false;  // what a command needs may stand in the file of --config
    bool wants_all = false;   // help texts list all options, not the basic ones alone
};

/// Adds a command with its arguments and options. Where the command is chosen, `action` becomes the call of `run` with
/// the settings; that call throws Error(kUsage) for bad values.
void add_command(CLI::App& app, const CommandSpec& command, int (*run)(const Settings&), const Typed& typed,
                 Action& action);

}  // namespace regionmesh::cli
