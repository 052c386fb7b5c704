// The program, for a main function of its own.
#pragma once

#include <string>

namespace regionmesh::cli {

/// What begins each line on standard error; "regionmesh: " by default. Of several processes of one run, those that do
/// not say all leave out errors in the command line, which each of them finds.
void name_process(std::string name, bool says_all);

/// Runs the command line and returns the exit code.
int run_program(int argc, char** argv);

}  // namespace regionmesh::cli
