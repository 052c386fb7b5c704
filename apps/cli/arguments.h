// Arguments as typed, before CLI11 reads them.
#pragma once

#include <string>
#include <vector>

#include "regionmesh/options.h"

namespace regionmesh::cli {

/// The arguments without the name of the program; labels that follow an option of labels become one value:
/// `--background 0 1 scan.nii.gz` is `--background 0,1 scan.nii.gz`. A file with such a name is left where it is.
/// `help COMMAND` becomes `COMMAND --help`.
std::vector<std::string> arguments_of(int argc, char** argv);

/// What is wrong with a command or an option that does not exist, and which one may be meant; empty where all exist.
std::string unknown_word(const std::vector<std::string>& arguments);

/// "redcue: reconstruct has no such option; did you mean reduce?". `name` may begin with dashes; then so does the
/// guess.
std::string no_such_option(const CommandSpec& command, const std::string& name);

/// The command among the arguments; null where there is none.
const CommandSpec* command_in(const std::vector<std::string>& arguments);

}  // namespace regionmesh::cli
