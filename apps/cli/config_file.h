// Options from a file, for --config.
#pragma once

#include "regionmesh/options.h"

namespace regionmesh::cli {

/// Adds the options in the file that `values` names as "config", where it names one, for those that `values` does not
/// have. Keys are names of options, without dashes in front; they stand alone or in a table with the name of the
/// command. A list gives an option several times, or the parts of one value. Throws Error for a file that cannot be
/// read, and for a key that is no option of the command.
void add_config(OptionValues& values, const CommandSpec& command);

/// Throws Error(kUsage) where an argument or an option that the command needs is missing.
void require_complete(const OptionValues& values, const CommandSpec& command);

}  // namespace regionmesh::cli
