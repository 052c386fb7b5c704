// The options of the programs, for Python.
#pragma once

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <string>

#include "regionmesh/options.h"

namespace regionmesh::python {

/// The declared options of a command, each as a dict. Throws ValueError for another command.
pybind11::list option_rows(const std::string& command);

/// The settings that the texts describe, checked against the kind of input. Throws Error(kUsage) with the line that the
/// program would print.
/// A message with arguments of Python for the flags of the command line: "reduce=2: not a share".
std::string with_arguments(const std::string& text);

Settings settings_from(const OptionValues& values, const std::vector<std::string>& inputs = {});

}  // namespace regionmesh::python
