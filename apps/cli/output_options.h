// The options that say how to write a model, shared by all commands that do.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "regionmesh/formats.h"
#include "regionmesh/regionmesh.h"

namespace regionmesh::cli {

/// For help texts.
extern const std::string kMeshWritten;

struct OutputOptions {
    std::string path, names;
    bool per_region = false;

    /// Adds -o, --names and --per-region.
    void add_options(CLI::App& command);
    /// The same without -o.
    void add_content_options(CLI::App& command);
    /// Throws what writing would, and what the table of names is refused for: before the work.
    void require_writable(bool boundary_is_open) const;
    /// Names from --names, or else those found with the input.
    LabelNames names_or(const LabelNames& found) const;
    void write(const Mesh& mesh, const LabelTable& labels, const std::vector<Label>& background,
               const LabelNames& region_names) const;
};

}  // namespace regionmesh::cli
