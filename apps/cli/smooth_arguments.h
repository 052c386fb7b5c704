// The options that say how to smooth, shared by the commands that do.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>

#include "regionmesh/formats.h"
#include "regionmesh/regionmesh.h"

namespace regionmesh::cli {

struct SmoothArguments {
    std::uint32_t passes = 20;
    std::string filter = "taubin", lambda = "0.6";
    bool points = false;

    /// Adds --smooth, --smooth-filter, --smooth-lambda and --smooth-points.
    void add_options(CLI::App& command);
    /// Throws Error(kInput) for a lambda beyond 0 to 1.
    SmoothOptions options() const;
};

}  // namespace regionmesh::cli
