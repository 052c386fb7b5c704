// The options that say how to read points or a mesh of tetrahedra.
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include "input_options.h"
#include "regionmesh/formats.h"
#include "regionmesh/regionmesh.h"

namespace regionmesh::cli {

struct TetrahedraArguments {
    std::string columns, step, scale_z, array;
    bool hull = false;

    /// Adds --columns, --step, --scale-z, --array and --hull.
    void add_options(CLI::App& command);
    /// Whether the input is points or a mesh. Throws Error(kInput) for options of the other kind of input.
    bool is_meant(const std::vector<std::string>& inputs, const InputOptions& volume) const;
    std::unique_ptr<TetrahedronReader> open(const std::vector<std::string>& inputs) const;
};

/// Calls visit(reader) for the reader of the input, whichever kind it is of, and returns what that does.
template <class Visit>
auto with_reader(const std::vector<std::string>& inputs, const InputOptions& volume,
                 const TetrahedraArguments& tetrahedra, Visit&& visit) {
    if (tetrahedra.is_meant(inputs, volume)) return visit(*tetrahedra.open(inputs));
    return visit(*volume.open(inputs));
}

}  // namespace regionmesh::cli
